#pragma once
// Shows the error of an image as an image.

#include <vector>

#include "core/image.hpp"

namespace triptych::report {

// The error of each pixel as a share of its bound: 0 is black, followed by blue and yellow, and the
// bound itself is white. A pixel is cyan if its error exceeds the bound, if a value is not finite,
// or if it shows another particle than the reference. Cyan differs from every colour of the ramp in
// lightness, or by blue against yellow, which readers without red or green cones can distinguish.
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
