#pragma once
#include <vector>

#include "backends/gl/context.hpp"
#include "measure/contract/features.hpp"

namespace triptych::gl_backend {

// Returns the feature probes, each of which checks that the driver executes one feature of the API
// correctly. They keep a reference to the context.
[[nodiscard]] std::vector<measure::FeatureProbe> feature_probes(Context& context);

}  // namespace triptych::gl_backend
