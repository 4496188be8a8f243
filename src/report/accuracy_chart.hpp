#pragma once
#include <span>
#include <string>

#include "judge/accuracy/cases.hpp"

namespace triptych::report {

enum class Cost { time, samples };

// Vega-Lite specification (JSON text): error against the limit across, cost up, both logarithmic; a
// row per scene, a column per device, a line per family, the front in black, the goals as rules. A
// case without error or without cost has no place on such axes and is left out.
// Scenes are named by accuracy_title.
[[nodiscard]] std::string accuracy_chart(std::span<const judge::AccuracyScene> scenes, Cost cost);

// The data, and those factors of the picture that tell it from the others of the same data.
[[nodiscard]] std::string accuracy_title(std::span<const judge::AccuracyScene> scenes,
                                         const judge::AccuracyScene& scene);

}  // namespace triptych::report
