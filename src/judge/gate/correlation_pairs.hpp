#pragma once
// From records and baselines to the cases of the correlation model.

#include <set>
#include <string>
#include <vector>

#include "judge/gate/run_view.hpp"

namespace triptych::judge {

// Every device of the run against every stored one, where it has stored runs against those as well,
// and against every other device of the run (once each). Configurations whose picture is wrong are
// left out, and those that the two devices' clocks of different kinds have timed. Anchors are the
// plan's own and those of the store's latest run of anchors_plan.
[[nodiscard]] std::vector<CorrelationPair> correlation_pairs(const RunView& view,
                                                             const WrongImages& wrong);

// Ids of the devices that some stored one can judge.
[[nodiscard]] std::set<std::string> decided_devices(const std::vector<CorrelationPair>& pairs);

// Whether this pair is told only beside what decides about its device, one of `decided`. A device's
// own history never is: where it cannot judge, that is news.
[[nodiscard]] bool is_beside_what_decides(const CorrelationPair& pair,
                                          const std::set<std::string>& decided);

}  // namespace triptych::judge
