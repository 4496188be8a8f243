#pragma once
// The verdict on a run, from records and baselines only.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "accuracy/cases.hpp"
#include "core/error.hpp"
#include "core/image.hpp"
#include "judge/baselines/baselines.hpp"
#include "judge/correlation/pair.hpp"
#include "judge/finding.hpp"
#include "judge/gate/open_counts.hpp"
#include "judge/stress/stress.hpp"
#include "record/store.hpp"

namespace triptych::judge {

struct GateResult {
  std::string plan;
  std::string run;
  std::vector<Finding> findings;  // the worst first, then by device and configuration
  // The errors of the scenes, by device, then in the order of measuring.
  std::vector<accuracy::AccuracyScene> accuracies = {};
  std::vector<CorrelationPair> correlations = {};  // the pairs that could be drawn
  std::set<std::string> devices = {};              // the requested devices that measured something
  // The settings that were made for each device when it was measured, by its id. Printed commands
  // repeat them.
  std::map<std::string, std::map<std::string, std::string>> environments = {};
  std::string argument = {};                         // copied from the request
  std::map<std::string, std::string> defaults = {};  // copied from the request
  std::string baselines = {};                        // the folder, if commands have to name it
  bool times_decided = false;                        // copied from the request
  bool part = false;                                 // copied from the request
  // Notes about the run: loaders and drivers that could not be used while devices were listed, the
  // injected faults with the number of their records, the program that measured if it is not the
  // one that judges, and the day of a run that began more than a day ago, because a later run may
  // have failed before it began. The last screen shows all of these, for every verdict.
  std::vector<record::Unusable> unusable = {};
  std::map<std::string, std::size_t> injected = {};
  std::string measured_by = {};
  std::string began = {};
  // Devices whose findings are all advisory or skips.
  [[nodiscard]] std::vector<std::string> nothing_decided() const;
  [[nodiscard]] core::ExitCode exit_code() const;
};

struct GateRequest {
  std::string plan;
  // The plan as commands accept it; if empty, its name is used (record::plan_argument).
  std::string argument = {};
  // " --store FILE" and " --baselines FOLDER", which printed commands must contain unless these are
  // the default ones.
  std::string store_option = {};
  std::string baselines_option = {};
  std::set<Check> checks;            // empty: those of the run's plan (checked_in)
  std::vector<std::string> devices;  // globs; empty: all in the run
  // Globs; each must match a device that measured something.
  std::vector<std::string> required_devices;
  // Globs over devices that this machine lacks on purpose, and over APIs whose devices cannot be
  // listed here.
  std::vector<std::string> without_devices = {};
  std::string program = {};  // the judging program's version; empty: not compared
  // The reference image for a record's scene, with the bound for the record's path. The suite
  // computes it, and the caller stores it.
  FindTruth truth;
  // The limit of a record's scene, nullptr if it has none. It must live as long as the request.
  std::function<const accuracy::LimitPicture*(const record::Record&)> limit = {};
  // The requirements for a record in addition to its reference image; empty: none.
  FindExpectations expectations = {};
  FindOpenCounts open_counts = {};  // called only if counters differ
  std::string today;                // ISO date, for the expiry of waivers
  // If true, a device that has only advisory findings and skips gets a finding. If false, which is
  // for the test of a single check, that test is skipped.
  bool decides_each_device = true;
  // A configuration that is slower than stored by more than its interval and by more than 2 % is a
  // regression. Otherwise times are advisory.
  bool times_decide = false;
  // The hash and the configuration keys of the current plan, to recognize a run of another plan.
  // Empty: not known.
  std::string plan_hash = {};
  std::vector<std::string> expected = {};
  // Levels that these keys leave out, for the factors that the plan names.
  std::map<std::string, std::string> defaults = {};
  // `expected` is only a part of the plan, so other accepted configurations are not missing.
  bool part = false;
  // Known failures and skips. Everything else has to pass, and a skip that is not listed cannot be
  // judged. nullopt: any configuration may be skipped.
  std::optional<std::vector<Waiver>> known = {};
  // The content hash of the data from which the record's reference image would be drawn now, in the
  // record's voxel format; empty if it is not known. An empty function: it is the record's own.
  std::function<std::string(const record::Record&)> data_hash = {};
};

// The checks that judge_run can judge.
[[nodiscard]] std::set<Check> judged_checks();

// `run` is its id; if it is empty, no run was begun, which cannot be judged. Throws InputError for
// a corrupt baseline (with file and line), but never because of what was measured.
[[nodiscard]] GateResult judge_run(const record::Store& store, const std::string& run,
                                   const Baselines& baselines, const GateRequest& request);

}  // namespace triptych::judge
