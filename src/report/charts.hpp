#pragma once
#include <string>

#include "report/html.hpp"
#include "report/page_sections.hpp"

namespace triptych::report {

// The distributions of times, HTML: a figure per scene, a row per device and technique; every timed
// frame as a stroke, quartiles as a box, logarithmic milliseconds.
[[nodiscard]] Html time_chart(const PlanData& plan);

}  // namespace triptych::report
