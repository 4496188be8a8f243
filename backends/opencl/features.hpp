#pragma once
#include <vector>

#include "backends/opencl/programs.hpp"
#include "measure/contract/features.hpp"

namespace triptych::opencl_backend {

// Returns the feature probes, each of which checks that the driver executes one feature of the API
// correctly. They keep references to the session and to its programs.
[[nodiscard]] std::vector<measure::FeatureProbe> feature_probes(const Session& session,
                                                                Programs& programs);

}  // namespace triptych::opencl_backend
