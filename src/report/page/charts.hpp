#pragma once
#include <string>

#include "report/html.hpp"
#include "report/page/page_sections.hpp"

namespace triptych::report {

// The distributions of times as HTML: a figure for each scene, with a row for each device and
// technique. Every timed frame is a stroke and the quartiles are a box, on a logarithmic axis in
// milliseconds.
[[nodiscard]] Html time_chart(const PlanData& plan);

}  // namespace triptych::report
