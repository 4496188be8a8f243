#pragma once
// The error of an image as an image.

#include <vector>

#include "core/image.hpp"

namespace triptych::report {

// The error as a share of the bound: 0 is black, then blue and yellow follow, and the bound itself
// is white. The pixel is cyan where the error exceeds the bound, where a value is not finite, and
// where another particle is visible than there must be. Cyan differs from every color of the ramp
// by lightness, or by blue against yellow, which readers without red or green cones distinguish.
struct ShareOfBound {
  core::Image image;
  int x = -1;  // the first pixel with the largest share; -1 if no pixel has an error
  int y = -1;
  // Pixels beyond the bound that get a ring, the worst first, because a single pixel is easily
  // missed. They are so far from each other that their rings do not overlap.
  struct Mark {
    int x;
    int y;
  };
  std::vector<Mark> marks = {};
  int ring = 0;  // radius in pixels
};

[[nodiscard]] ShareOfBound share_of_bound(const core::Image& image, const core::Image& truth,
                                          const core::Image& bound);

}  // namespace triptych::report
