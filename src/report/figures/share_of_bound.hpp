#pragma once
// Computes the difference image, which shows the error of an image.

#include <vector>

#include "core/image.hpp"

namespace triptych::report {

// An image of the error of each pixel as a share of its error bound. The colour ramp goes from
// black (no error) through blue and yellow to white (equal to the bound). If the error exceeds the
// bound, the colour lies between azure (slightly) and cyan (by the largest finite factor in the
// image), on a logarithmic scale. A pixel is also cyan if its bound is 0, if a value is not finite,
// or if the pixel shows a different particle than the reference image. Azure and cyan differ from
// every colour of the ramp either in lightness or on the blue-yellow axis, so that colour-blind
// readers without red or green cones can distinguish them. The sign of an error is not shown,
// because no third hue has this property.
struct ShareOfBound {
  core::Image image;
  double largest_finite = 0;  // the largest finite share
  int x = -1;                 // the first pixel with the largest share; -1 if no pixel has an error
  int y = -1;
  // Pixels beyond the bound that get a ring, the worst first. The rings make single pixels
  // noticeable. Only pixels that are far enough apart get a ring, so that rings do not overlap.
  struct Mark {
    int x;
    int y;
  };
  std::vector<Mark> marks = {};
  int ring_radius = 0;  // radius in pixels
};

[[nodiscard]] ShareOfBound share_of_bound(const core::Image& image, const core::Image& truth,
                                          const core::Image& bound);

}  // namespace triptych::report
