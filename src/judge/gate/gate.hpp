#pragma once
// The verdict on a run, from records and baselines alone.

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
  std::vector<Finding> findings;  // worst first, then by device and configuration
  std::vector<accuracy::AccuracyScene> accuracies = {};  // likewise; by device, then as measured
  std::vector<CorrelationPair> correlations = {};        // those that could be drawn
  std::set<std::string> devices = {};  // that measured something, of those asked for
  // What was set for a device when it was measured, by its id; commands repeat it.
  std::map<std::string, std::map<std::string, std::string>> environments = {};
  std::string argument = {};                         // as of the request
  std::map<std::string, std::string> defaults = {};  // likewise
  std::string baselines = {};                        // the folder, where commands have to name it
  bool times_decided = false;                        // as of the request
  bool part = false;                                 // likewise
  // Of the run: what was met while its devices were listed and cannot be used, the faults that were
  // injected with the number of their records, and the program that measured it where that is not
  // the one that judges. The last screen shows all of these, whatever the verdict.
  std::vector<record::Unusable> unusable = {};
  std::map<std::string, std::size_t> injected = {};
  std::string measured_by = {};
  // Of which all findings are advice or reasons for not judging.
  [[nodiscard]] std::vector<std::string> nothing_decided() const;
  [[nodiscard]] core::ExitCode exit_code() const;
};

struct GateRequest {
  std::string plan;
  // The plan as commands take it; empty: its name has to do (record::plan_argument).
  std::string argument = {};
  // " --store FILE", " --baselines FOLDER": what commands have to be told where neither is usual.
  std::string store_option = {};
  std::string baselines_option = {};
  std::set<Check> checks;            // empty: those of the run's plan (checked_in)
  std::vector<std::string> devices;  // globs; empty: all in the run
  std::vector<std::string>
      required_devices;  // globs; each must match a device that measured something
  // Globs over devices that this machine is meant to lack, and over APIs whose devices cannot be
  // listed here.
  std::vector<std::string> without_devices = {};
  std::string program = {};  // the judging program's version; empty: not compared
  // The truth for a record's scene with the bound that holds for the record's path. Computed by the
  // suite, cached in the store by the caller.
  FindTruth truth;
  // The limit of a record's scene, nullptr where it has none; it lives as long as the request.
  std::function<const accuracy::LimitPicture*(const record::Record&)> limit = {};
  // What must hold of a record beside its truth; nothing: no record has any.
  FindExpectations expectations = {};
  FindOpenCounts open_counts = {};  // asked only where counters differ
  std::string today;                // ISO date, for the expiry of waivers
  // A device of which all is advice or skips is a finding. A test of one check is skipped instead.
  bool decides_each_device = true;
  // A configuration that is slower than stored by more than its interval and 2 % is a regression;
  // else times advise.
  bool times_decide = false;
  // Of the plan as it is now, to tell a run of another: its hash, and its configurations' keys.
  // Empty: not known.
  std::string plan_hash = {};
  std::vector<std::string> expected = {};
  // Levels that these keys leave out, of the factors that the plan names.
  std::map<std::string, std::string> defaults = {};
  // `expected` is but a part of the plan: what was accepted beside it is not missed.
  bool part = false;
  // What is known to fail or to be skipped; all else has to pass, and a skip that is not among them
  // cannot be judged. Nothing: skips are as they come.
  std::optional<std::vector<Waiver>> known = {};
  // Content hash of the data that the record's truth would be drawn from now, in the record's voxel
  // format; empty where that cannot be told. Nothing: it is the record's.
  std::function<std::string(const record::Record&)> data_hash = {};
};

// Those that judge_run can judge.
[[nodiscard]] std::set<Check> judged_checks();

// `run`: its id; empty where none was begun, which cannot be judged. Throws InputError for a
// corrupt baseline (file and line), never because of what was measured.
[[nodiscard]] GateResult judge_run(const record::Store& store, const std::string& run,
                                   const Baselines& baselines, const GateRequest& request);

}  // namespace triptych::judge
