#pragma once
// Functions that all judging commands share.

#include <string>
#include <vector>

#include "app/ci_system.hpp"
#include "judge/gate/gate.hpp"
#include "measure/plan/plan.hpp"
#include "measure/truth/truths.hpp"
#include "record/store.hpp"

namespace triptych::app {

// Throws core::NotSupported with the command that measures if the store does not exist.
void require_store(const std::filesystem::path& file);

// Opens the store to judge its runs. It is opened for appending, so that reference images are saved
// for the next time, or for reading if it is read-only. Throws NotSupported if it does not exist,
// and any error that record::Store throws.
[[nodiscard]] record::Store open_to_judge(const std::string& file);

// The id of the plan's latest run. Throws NotSupported (nothing to judge) if there is none. `plan`
// is a name or a YAML file as it was typed. `file` is the name of the store in the message.
[[nodiscard]] std::string latest_run_of(const record::Store& store, const std::string& plan,
                                        const std::string& file);

// " --store FILE" for commands that are printed, if the store is not the default one.
[[nodiscard]] std::string store_option(const std::string& file);

// Like judge::judge_run. If a library throws because of the store's content, the error names the
// store.
[[nodiscard]] judge::GateResult judge_named(const record::Store& store, const std::string& run,
                                            const std::string& baselines,
                                            const judge::GateRequest& request);

// A request to judge a plan on all devices with every check of the plan, with these reference
// images, as of today.
[[nodiscard]] judge::GateRequest request_of(measure::Truths& truths, const std::string& plan);
// The same for the current version of a plan, with its configurations.
[[nodiscard]] judge::GateRequest request_of(measure::Truths& truths, const measure::Plan& plan,
                                            const measure::Suite& suite);

// Turns findings that could not be judged only because data files are missing into skips, for
// machines that are meant to lack these files. A failure of a device is never excused.
void excuse_absent_data(const record::Store& store, judge::GateResult& result);

// The files to which a verdict is written; empty: not written.
struct VerdictFiles {
  std::string folder;  // files for a CI system: see report/ci/folder.hpp
  std::string junit;
  std::string markdown;
  std::string json;       // "-": printed instead of the last screen
  std::string baselines;  // the folder of the baselines that were used
  CiSystem ci = CiSystem::none;
};

// Writes the files and the output for the CI system, and prints the last screen, which lists the
// files in the folder. `seconds` is the total time. Returns the exit code over all results.
core::ExitCode tell_verdict(const record::Store& store, measure::Truths& truths,
                            const std::vector<judge::GateResult>& results, double seconds,
                            const VerdictFiles& files);

// The HTML page about the latest run of each plan in a store, judged by all checks of the plan. The
// store must contain a run.
[[nodiscard]] std::string page_of(const record::Store& store, measure::Truths& truths,
                                  const std::string& baselines);

}  // namespace triptych::app
