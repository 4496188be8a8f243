#pragma once
// The distance of a picture from the truth, as a picture.

#include "core/image.hpp"

namespace triptych::report {

// The error as a share of the bound: 0 is black, then blue and yellow follow, and the bound itself
// is white. The value is NaN, which PNGs show as magenta, where the error exceeds the bound, where
// a value is not finite, and where another particle is visible than there must be.
struct ShareOfBound {
  core::Image image;
  int x = -1;  // the first pixel with the largest share; -1 if no pixel has an error
  int y = -1;
};

[[nodiscard]] ShareOfBound share_of_bound(const core::Image& image, const core::Image& truth,
                                          const core::Image& bound);

}  // namespace triptych::report
