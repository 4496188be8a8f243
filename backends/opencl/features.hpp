#pragma once
#include <vector>

#include "backends/opencl/programs.hpp"
#include "measure/contract/features.hpp"

namespace triptych::opencl_backend {

// The probes, which refer to the session and its programs.
[[nodiscard]] std::vector<measure::FeatureProbe> feature_probes(const Session& session,
                                                                Programs& programs);

}  // namespace triptych::opencl_backend
