#pragma once
#include <span>
#include <string>

#include "report/html.hpp"
#include "accuracy/cases.hpp"

namespace triptych::report {

enum class Cost { time, samples, instructions, fetched, memory, energy };

// HTML, a figure per scene and device: error against the limit across, cost up, both logarithmic; a
// line per family, the front in ink, the goals as upright rules. A case without error or without
// cost has no place on such axes and is left out; empty where none has one. Scenes are named by
// accuracy_title.
[[nodiscard]] Html accuracy_chart(std::span<const accuracy::AccuracyScene> scenes,
                                         Cost cost);

// The data, and those factors of the picture that tell it from the others of the same data.
[[nodiscard]] std::string accuracy_title(std::span<const accuracy::AccuracyScene> scenes,
                                         const accuracy::AccuracyScene& scene);

}  // namespace triptych::report
