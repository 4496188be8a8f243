#pragma once
#include <string>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// Vega-Lite specification (JSON text) of a pair of devices: cost or time on the one against the
// other, both logarithmic, a point per configuration, and the line that was fitted.
[[nodiscard]] std::string correlation_chart(const judge::CorrelationPair& pair);

}  // namespace triptych::report
