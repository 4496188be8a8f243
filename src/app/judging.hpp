#pragma once
// What commands that judge share.

#include <string>
#include <vector>

#include "app/truth.hpp"
#include "judge/gate/gate.hpp"
#include "record/store.hpp"

namespace triptych::app {

// The store to judge from: to append to, so that truths are kept for the next time, else, where it
// is read-only, to read. Throws NotSupported when there is none, and as record::Store does.
[[nodiscard]] record::Store open_to_judge(const std::string& file);

// Id of the plan's latest run; throws NotSupported (nothing to judge) when there is none. `plan`: a
// name or a YAML file, as it was typed. `file`: what the message calls the store.
[[nodiscard]] std::string latest_run_of(const record::Store& store, const std::string& plan,
                                        const std::string& file);

// Every finding but those that pass, a line each, then how many there are of each verdict and the
// headline.
[[nodiscard]] std::string text_of(const judge::GateResult& result);

// judge::judge_run, whatever the store's content makes a library throw being an error that names
// it.
[[nodiscard]] judge::GateResult judge_named(const record::Store& store, const std::string& run,
                                            const std::string& baselines,
                                            const judge::GateRequest& request);

// The latest run of each plan in a store, by the plans' names.
[[nodiscard]] std::vector<record::Run> latest_runs(const record::Store& store);

// The report on the latest run of each plan in a store, which holds one.
[[nodiscard]] std::string page_of(const record::Store& store, Truths& truths,
                                  const std::string& baselines);

// Of two verdicts the one that counts: usage over regression over could not judge over pass.
[[nodiscard]] core::ExitCode worse_of(core::ExitCode a, core::ExitCode b);

}  // namespace triptych::app
