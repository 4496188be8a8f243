#pragma once
// Functions shared by all commands that judge the runs in a store.

#include <string>
#include <vector>

#include "app/ci_system.hpp"
#include "judge/gate/gate.hpp"
#include "measure/plan/plan.hpp"
#include "measure/truth/truths.hpp"
#include "record/store.hpp"

namespace triptych::app {

// Throws core::NotSupported if the store does not exist. The message contains the command that
// creates it.
void require_store(const std::filesystem::path& file);

// Opens the store to judge its runs. If the store is writable, it is opened for appending, so that
// reference images can be saved in it; otherwise it is opened read-only. Throws NotSupported if the
// store does not exist, and any error that record::Store throws.
[[nodiscard]] record::Store open_to_judge(const std::string& file);

// Returns the id of the plan's latest run. Throws NotSupported if there is none. `plan` is a plan's
// name or a YAML file, as typed by the user. `file` is the store's name for the message.
[[nodiscard]] std::string latest_run_of(const record::Store& store, const std::string& plan,
                                        const std::string& file);

// Returns " --store FILE" for printed commands, or an empty string if the store is the default
// store.
[[nodiscard]] std::string store_option(const std::string& file);

// Like judge::judge_run(), but if a library throws because of the store's content, the error names
// the store.
[[nodiscard]] judge::GateResult judge_stored_run(const record::Store& store, const std::string& run,
                                                 const std::string& baselines,
                                                 const judge::GateRequest& request);

// Returns a request to judge a plan on all devices with all of the plan's checks, using the
// reference images in `truths`. Waivers that have expired by today's date do not apply. The caller
// adds the names of the plans that exist (GateRequest::known_plans), if it shows unused waivers.
[[nodiscard]] judge::GateRequest request_of(measure::Truths& truths, const std::string& plan);
// Like the overload above, but for the plan as it is currently defined, including the
// configurations that the run should contain.
[[nodiscard]] judge::GateRequest request_of(measure::Truths& truths, const measure::Plan& plan,
                                            const measure::Suite& suite);

// Changes each cannot_judge finding to a skip if a missing data file is its only cause. This is for
// machines on which data files are missing on purpose. A device failure is never excused.
void excuse_absent_data(const record::Store& store, judge::GateResult& result);

// The files to which a verdict is written. A file whose name is empty is not written.
struct VerdictFiles {
  std::string folder;  // the folder for the files described in report/ci/folder.hpp
  std::string junit;
  std::string markdown;
  std::string json;  // "-": print JSON instead of the summary in report/screen/summary_screen.hpp
  std::string baselines;  // the folder of the baselines that were used
  CiSystem ci = CiSystem::none;
};

// Writes the files and the output for the CI system, and prints a summary
// (report/screen/summary_screen.hpp), which lists the files in the folder. `seconds` is the total
// time of the command. Returns the exit code for all results.
core::ExitCode report_verdict(const record::Store& store, measure::Truths& truths,
                              const std::vector<judge::GateResult>& results, double seconds,
                              const VerdictFiles& files);

// Returns the HTML page about the latest run of each plan in the store, judged with all checks of
// the plan. The store must contain a run.
[[nodiscard]] std::string page_of(const record::Store& store, measure::Truths& truths,
                                  const std::string& baselines);

}  // namespace triptych::app
