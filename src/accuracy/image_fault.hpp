#pragma once

#include <string>
#include <string_view>

#include "accuracy/image_metrics.hpp"

namespace triptych::accuracy {

// Where a picture is worst, and by how much.
[[nodiscard]] std::string describe(const ImageComparison& comparison);

// What is wrong with a picture held against `name`, in one line; empty when nothing is.
[[nodiscard]] std::string image_fault(const ImageComparison& comparison, const core::Image& image,
                                      const core::Image& expected, std::string_view name);

}  // namespace triptych::accuracy
