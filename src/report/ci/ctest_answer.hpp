#pragma once
// The result of a check as output of a CTest test: text for the log, numbers and images for the
// dashboard.

#include <optional>
#include <string>

#include "judge/gate/gate.hpp"
#include "judge/stress/stress.hpp"
#include "record/store.hpp"

namespace triptych::report {

// The findings, the numbers of the worst one, and the headline. With `truth`, also the three
// images for the configuration of the worst finding, which are written among the temporary files;
// without it, no images.
[[nodiscard]] std::string ctest_answer(const judge::GateResult& result, const record::Store& store,
                                       const judge::FindTruth& truth);

// A check that has only advisory findings or skips has judged nothing. It is a skip with this
// reason, never a pass.
[[nodiscard]] std::optional<std::string> reason_to_skip(const judge::GateResult& result);

}  // namespace triptych::report
