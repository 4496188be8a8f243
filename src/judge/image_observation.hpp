#pragma once
// Describes the errors in an image as an Observation.

#include "accuracy/image_metrics.hpp"
#include "judge/finding.hpp"

namespace triptych::judge {

// Converts `comparison`, the result of comparing `image` with `expected`, to an Observation. Its
// cause is Cause::within_bound if the image is correct.
[[nodiscard]] Observation image_observation(const accuracy::ImageComparison& comparison,
                                            const core::Image& image, const core::Image& expected,
                                            Against against);

}  // namespace triptych::judge
