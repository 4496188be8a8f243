#pragma once
// What commands that judge share.

#include <string>
#include <vector>

#include "judge/gate/gate.hpp"
#include "measure/plan/plan.hpp"
#include "measure/truth/truths.hpp"
#include "record/store.hpp"

namespace triptych::app {

// Throws core::NotSupported saying how to measure when there is no such store.
void require_store(const std::filesystem::path& file);

// The store to judge from: to append to, so that truths are kept for the next time, else, where it
// is read-only, to read. Throws NotSupported when there is none, and as record::Store does.
[[nodiscard]] record::Store open_to_judge(const std::string& file);

// Id of the plan's latest run; throws NotSupported (nothing to judge) when there is none. `plan`: a
// name or a YAML file, as it was typed. `file`: what the message calls the store.
[[nodiscard]] std::string latest_run_of(const record::Store& store, const std::string& plan,
                                        const std::string& file);

// " --store FILE", what commands have to be told where the store is not the usual one.
[[nodiscard]] std::string store_option(const std::string& file);

// judge::judge_run, whatever the store's content makes a library throw being an error that names
// it.
[[nodiscard]] judge::GateResult judge_named(const record::Store& store, const std::string& run,
                                            const std::string& baselines,
                                            const judge::GateRequest& request);

// A request to judge a plan on all devices by every check that is made for it, with these truths,
// today.
[[nodiscard]] judge::GateRequest request_of(measure::Truths& truths, const std::string& plan);
// The same of a plan as it is now: which configurations it has.
[[nodiscard]] judge::GateRequest request_of(measure::Truths& truths, const measure::Plan& plan,
                                            const measure::Suite& suite);

// Where a verdict is written; empty: not there.
struct VerdictFiles {
  std::string folder;  // for a CI: report.html, gate.log, summary.md, benchmark.json and JUnit XML
  std::string junit;
  std::string markdown;
  std::string json;  // "-": printed instead of the last screen
};

// Writes the files and prints the last screen, which names those of the folder; `seconds`: that all
// took. The exit code that counts over all.
core::ExitCode tell_verdict(const record::Store& store, measure::Truths& truths,
                            const std::vector<judge::GateResult>& results, double seconds,
                            const VerdictFiles& files);

// The report on the latest run of each plan in a store, which holds one, judged by all that the
// plan is for.
[[nodiscard]] std::string page_of(const record::Store& store, measure::Truths& truths,
                                  const std::string& baselines);

}  // namespace triptych::app
