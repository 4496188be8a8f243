#pragma once
#include <string>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// Vega-Lite specification (JSON text) of a pair of devices: time on the one against time on the
// other, both logarithmic, a point per configuration coloured by technique, anchors as triangles;
// the line that was fitted, the anchors' own one dashed. Beside it the deviations from the line,
// those that are slower or faster named.
[[nodiscard]] std::string correlation_chart(const judge::CorrelationPair& pair);

}  // namespace triptych::report
