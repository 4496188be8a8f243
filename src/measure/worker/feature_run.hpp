#pragma once
// Probes the features of a device in a separate process (own_program.hpp), so that a driver that
// crashes or hangs affects only one probe.

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "measure/contract/backend.hpp"
#include "measure/contract/features.hpp"

namespace triptych::measure {

struct FeatureRow {
  std::string name;
  ProbedFeature probed;
  std::optional<record::Reason> ended = {};  // if the process crashed or was too slow
};

// All probes of the device in their order; with `only`, the one with that name. If the device
// cannot be opened, there is one row without a name that has the reason. `limit` applies to each
// probe.
[[nodiscard]] std::vector<FeatureRow> probe_features(const std::string& device,
                                                     const std::string& only,
                                                     std::chrono::seconds limit);

// The main function of that process: it opens the device and answers requests until there are no
// more.
void answer_features(const Backend& backend, const std::string& device);

}  // namespace triptych::measure
