#pragma once
#include <span>
#include <string>

#include "accuracy/cases.hpp"
#include "report/html.hpp"

namespace triptych::report {

enum class Cost { time, samples, instructions, fetched, memory, energy };

// HTML with a figure for each scene and device. The horizontal axis is the error against the limit
// image and the vertical axis is the cost, both logarithmic. Each family has a line, the front has
// the colour of ink, and the goals are vertical lines. Devices share the axes of a scene. A case
// without error or without cost cannot be shown and is left out; if that applies to all cases, the
// result is empty. Scenes are named by accuracy_title.
[[nodiscard]] Html accuracy_chart(std::span<const accuracy::AccuracyScene> scenes, Cost cost);

// The data, and the image factors that distinguish this scene from other scenes with the same data.
[[nodiscard]] std::string accuracy_title(std::span<const accuracy::AccuracyScene> scenes,
                                         const accuracy::AccuracyScene& scene);

}  // namespace triptych::report
