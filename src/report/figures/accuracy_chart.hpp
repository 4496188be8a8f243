#pragma once
#include <span>
#include <string>

#include "accuracy/cases.hpp"
#include "report/html.hpp"

namespace triptych::report {

enum class Cost { time, samples, instructions, fetched, memory, energy };

// HTML with a figure for each scene and device. The error against the limit is the horizontal axis
// and the cost the vertical one, both logarithmic. There is a line for each family; the front has
// the colour of ink, and the goals are vertical lines. A case without error or without cost cannot
// be shown and is left out; the result is empty if that applies to all. Scenes are named by
// accuracy_title.
[[nodiscard]] Html accuracy_chart(std::span<const accuracy::AccuracyScene> scenes, Cost cost);

// The data, and the factors of the image that distinguish it from others of the same data.
[[nodiscard]] std::string accuracy_title(std::span<const accuracy::AccuracyScene> scenes,
                                         const accuracy::AccuracyScene& scene);

}  // namespace triptych::report
