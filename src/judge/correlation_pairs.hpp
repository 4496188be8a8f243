#pragma once
// From records and baselines to the cases of the correlation model.

#include <vector>

#include "judge/run_view.hpp"

namespace triptych::judge {

// Every device of the run against every stored device with another key, and against every other
// device of the run (once each). Configurations whose picture is wrong are left out, and those that
// the two devices' clocks of different kinds have timed. Anchors are the plan's own and those of
// the store's latest run of anchors_plan.
[[nodiscard]] std::vector<CorrelationPair> correlation_pairs(const RunView& view,
                                                             const WrongImages& wrong);

}  // namespace triptych::judge
