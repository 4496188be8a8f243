#pragma once
// Judges a run by its records and the baselines.

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

// The driver of a device, as shown with the verdict.
struct TestedDevice {
  std::string driver;          // name of the driver
  std::string driver_version;  // as reported by the driver
  bool accepted = true;        // false if the baselines contain no results of this driver version
};

struct GateResult {
  std::string plan;
  std::string run;
  std::vector<Finding> findings;  // in the order of sort_findings() (gate/run_view.hpp)
  // The errors against the limit images (the images with exact ray integrals), one entry for each
  // scene on each device.
  std::vector<accuracy::AccuracyScene> accuracies = {};
  std::vector<CorrelationPair> correlations = {};  // the pairs of devices that the report plots
  std::set<Check> checks = {};                     // the checks that were requested
  std::set<std::string> devices = {};  // requested devices with at least one measurement
  // The devices of the run that the store describes, by id.
  std::map<std::string, TestedDevice> tested = {};
  // The environment variables with which each device was measured, including those that select its
  // driver, by device id. Printed commands set them again.
  std::map<std::string, std::map<std::string, std::string>> environments = {};
  std::string argument = {};                         // copied from the request
  std::map<std::string, std::string> defaults = {};  // copied from the request
  std::string baselines = {};                        // baselines folder, if commands must name it
  // The baselines folder, if it is not the folder `baselines` of the working directory, and whether
  // it was used only because the working directory has no such folder.
  std::string other_baselines = {};
  bool lacks_own_baselines = false;
  std::string waivers_file = {};  // waivers.json of the baselines
  bool times_decided = false;     // copied from the request
  bool part = false;              // copied from the request
  bool data_excused = false;      // missing data files are not an error
  // Notes about the run, which the final terminal output shows for every verdict: loaders and
  // drivers that failed during device enumeration; the injected faults, each with its number of
  // records; the program that measured, if it is not the program that judges; and the day on which
  // the run started, if that was more than a day ago, because a newer run may have failed to start.
  std::vector<record::Unusable> unusable = {};
  std::map<std::string, std::size_t> injected = {};
  std::string measured_by = {};
  std::string old_run_date = {};
  // Returns the devices that have only advisories and skips.
  [[nodiscard]] std::vector<std::string> undecided_devices() const;
  // Returns the requested checks that reached no verdict, with the devices for which this is the
  // case. The set of devices is empty if the check reached no verdict for any device. A device that
  // does not support a check, so that the check is only skipped, is not listed.
  [[nodiscard]] std::map<Check, std::set<std::string>> undecided_checks() const;
  [[nodiscard]] core::ExitCode exit_code() const;
};

struct GateRequest {
  std::string plan;
  // The plan as a command-line argument. If empty, it is derived from the plan's name
  // (record::plan_argument).
  std::string argument = {};
  // " --store FILE" and " --baselines FOLDER" for printed commands; empty for the defaults.
  std::string store_option = {};
  std::string baselines_option = {};
  // The command that finishes an incomplete run. If it is empty, it is `triptych run --resume`.
  std::string resume_command = {};
  std::set<Check> checks;            // empty: the checks of the run's plan (checks_of_run)
  std::vector<std::string> devices;  // globs; empty: all devices in the run
  // Globs, each of which must match a device on which something was measured.
  std::vector<std::string> required_devices;
  // Globs for devices that are absent from this machine on purpose, and for APIs whose device
  // enumeration may fail on this machine.
  std::vector<std::string> without_devices = {};
  // The version of the judging program, which is compared with the version of the program that
  // measured. If it is empty, the versions are not compared.
  std::string program = {};
  // Returns the reference image of a record's scene, and the error bound for the record's rendering
  // path. The suite computes both, and the caller caches them.
  FindTruth truth;
  // Returns the limit image of a record's scene, which shows the exact ray integral, or nullptr if
  // the scene has none. The limit image must live as long as the request.
  std::function<const accuracy::LimitImage*(const record::Record&)> limit = {};
  // Returns the expectations that a record must meet in addition to matching its reference image.
  // If the function is empty, there are none.
  FindExpectations expectations = {};
  FindOpenCounts open_counts = {};  // called only if counters differ
  std::string today;                // ISO date, for the expiry of waivers
  // If true, a device that has only advisories and skips gets a finding that it could not be
  // judged. Failed device enumerations and missing devices are reported, too. CTest tests of a
  // single check set this to false, because a test without a decision counts as skipped instead.
  bool decides_each_device = true;
  // If true, a configuration is a regression if the whole 95 % confidence interval of its slowdown
  // lies above 2 %. If false, times do not affect the verdict.
  bool times_decide = false;
  // The hash and the configuration keys of the current plan, to recognize a run of another version
  // of the plan. Empty if they are not known.
  std::string plan_hash = {};
  std::vector<std::string> expected = {};
  // The default levels of the factors that the plan names. Configuration keys omit factors that
  // have their default level.
  std::map<std::string, std::string> defaults = {};
  // Whether `expected` is only a part of the plan, so that accepted configurations outside this
  // part do not count as missing.
  bool part = false;
  // The known failures and skips. A configuration that is not in this list must pass; if it is
  // skipped, it cannot be judged. nullopt means that there is no list, so any configuration may be
  // skipped.
  std::optional<std::vector<Waiver>> expected_outcomes = {};
  // The names of the plans that exist, such as "volume/quick". A waiver that names another plan is
  // reported, unless there are baselines for that plan. Empty if they are not known.
  std::set<std::string> known_plans = {};
  // Returns the current content hash of the data from which the record's reference image is drawn,
  // in the record's voxel format, or "" if it is not known. If the function is empty, the data are
  // assumed to be unchanged.
  std::function<std::string(const record::Record&)> data_hash = {};
};

// Returns the checks that judge_run can judge.
[[nodiscard]] std::set<Check> judged_checks();

// Judges the run with the id `run`. An empty id means that no run was started, which cannot be
// judged. Throws InputError for a corrupt baseline (with file and line), but never because of a
// measured value.
[[nodiscard]] GateResult judge_run(const record::Store& store, const std::string& run,
                                   const Baselines& baselines, const GateRequest& request);

}  // namespace triptych::judge
