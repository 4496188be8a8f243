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
  std::optional<record::Reason> ended = {};  // set if the process crashed or hung
};

// Runs all probes of the device, one after the other. If `only` is not empty, runs only the probe
// with this name. `limit` is the time limit for each probe. If the device cannot be opened, the
// result is a single row without a name, which states the reason.
[[nodiscard]] std::vector<FeatureRow> probe_features(const std::string& device,
                                                     const std::string& only,
                                                     std::chrono::seconds limit);

// The main function of the separate process: opens the device and answers requests until the pipe
// is closed.
void answer_features(const Backend& backend, const std::string& device);

}  // namespace triptych::measure
