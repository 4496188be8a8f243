#pragma once
#include <string>

#include "report/html.hpp"
#include "report/page/page_sections.hpp"

namespace triptych::report {

// Returns the distributions of times: a figure for each scene, with a row for each device and
// technique. Each timed frame is a stroke, and a box spans the quartiles. The axis is logarithmic,
// in milliseconds.
[[nodiscard]] Html time_chart(const PlanData& plan);

}  // namespace triptych::report
