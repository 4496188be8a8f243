#pragma once
// What a check says as a CTest test: text for the log, numbers and pictures for the dashboard.

#include <optional>
#include <string>

#include "judge/gate/gate.hpp"
#include "judge/stress/stress.hpp"
#include "record/store.hpp"

namespace triptych::report {

// Findings, the numbers of the worst one and the headline. With `truth` also the three pictures of
// the worst one's configuration, which are written among the temporary files; empty: none.
[[nodiscard]] std::string ctest_answer(const judge::GateResult& result, const record::Store& store,
                                       const judge::FindTruth& truth);

// A check that only advises or skips has judged nothing: a skip with its reason, never a pass.
[[nodiscard]] std::optional<std::string> reason_to_skip(const judge::GateResult& result);

}  // namespace triptych::report
