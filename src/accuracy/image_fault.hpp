#pragma once

#include <string>
#include <string_view>

#include "accuracy/image_metrics.hpp"

namespace triptych::accuracy {

// The place where an image is worst, with the error.
[[nodiscard]] std::string describe(const ImageComparison& comparison);

// What is wrong with an image that was compared with `name`, in one line; empty if nothing is
// wrong.
[[nodiscard]] std::string image_fault(const ImageComparison& comparison, const core::Image& image,
                                      const core::Image& expected, std::string_view name);

}  // namespace triptych::accuracy
