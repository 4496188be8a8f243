#pragma once
// What a device's stored runs scatter by: each configuration, and the program beside the anchors.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "judge/baselines/baselines.hpp"
#include "judge/statistics/statistics.hpp"

namespace triptych::judge {

using StoredTimes = std::map<std::string, std::vector<StoredTiming>>;  // by configuration

// ln t by one clock of the stored runs but one.
[[nodiscard]] std::vector<double> runs_by(std::string_view clock, const StoredTimes& stored,
                                          const std::string& configuration,
                                          std::string_view but = {});

// Of ln t between runs, over all configurations that have several. As everywhere here from median
// absolute deviations: a slow minute of one run is no measure of the others, and the launch that
// settles what it says is quieter.
[[nodiscard]] VariancePrior scatter_between_runs(const StoredTimes& stored);

// Of one run, moderated, from the ln t of a configuration's `runs`; 0 where no configuration has
// two runs.
[[nodiscard]] KnownVariance variance_of_a_run(const VariancePrior& prior,
                                              const std::vector<double>& runs);

// Over the variance of one of so many runs, at least one: that of their median.
[[nodiscard]] double share_of_median(std::size_t runs);

// Of d = median of the configurations' deviations − that of the anchors' beside them, by stored run
// of one device, each deviation in ln t from the median of all runs: in it is a minute that only
// one of the two met, and nothing of how fast the device was. The run `but` is left out. Below
// three runs it is not known: 0 with no degrees.
[[nodiscard]] KnownVariance scatter_beside_anchors(const StoredTimes& program,
                                                   const StoredTimes& anchors,
                                                   std::string_view but);

}  // namespace triptych::judge
