#pragma once
#include <span>
#include <string>

#include "accuracy/cases.hpp"
#include "report/html.hpp"

namespace triptych::report {

enum class Cost { time, samples, instructions, fetched, memory, energy };

// Returns a figure for each scene and device. The horizontal axis shows the error against the limit
// image (the image with exact ray integrals), and the vertical axis the cost; both are logarithmic.
// The configurations that differ only in the step size are connected by a line. The Pareto front
// has the colour of the text. A vertical line marks each error for which the report states the cost
// (accuracy::accuracy_goals). The figures of a scene have the same axes on all devices. Cases whose
// error or cost is unknown are left out. If no case remains, the result is empty. accuracy_title()
// returns the names of the scenes.
[[nodiscard]] Html accuracy_chart(std::span<const accuracy::AccuracyScene> scenes, Cost cost);

// Returns the name of a scene: its data, and the factors that distinguish it from other scenes with
// the same data.
[[nodiscard]] std::string accuracy_title(std::span<const accuracy::AccuracyScene> scenes,
                                         const accuracy::AccuracyScene& scene);

}  // namespace triptych::report
