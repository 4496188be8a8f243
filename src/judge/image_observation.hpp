#pragma once
// The errors in an image, as data.

#include "accuracy/image_metrics.hpp"
#include "judge/finding.hpp"

namespace triptych::judge {

// The result of comparing `image` with `expected`; its cause is Cause::within_bound if nothing is
// wrong.
[[nodiscard]] Observation image_observation(const accuracy::ImageComparison& comparison,
                                            const core::Image& image, const core::Image& expected,
                                            Against against);

}  // namespace triptych::judge
