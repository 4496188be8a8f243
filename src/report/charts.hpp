#pragma once
#include <string>

#include "report/page_sections.hpp"

namespace triptych::report {

// Vega-Lite specification (JSON text) of the time distributions: every timed frame as a point,
// quartiles as a box, one facet per scene, logarithmic milliseconds.
[[nodiscard]] std::string time_chart(const PlanData& plan);

}  // namespace triptych::report
