#pragma once
// How far a picture is from the truth, as a picture.

#include "core/image.hpp"

namespace triptych::report {

// Error as a share of the bound: black 0, through blue and yellow to white at the bound itself;
// over it, where a value is not finite and where another particle is shown than must be, NaN, which
// PNGs show as magenta.
struct ShareOfBound {
  core::Image image;
  int x = -1;  // the first pixel of the largest share; -1 where no pixel is off
  int y = -1;
};

[[nodiscard]] ShareOfBound share_of_bound(const core::Image& image, const core::Image& truth,
                                          const core::Image& bound);

}  // namespace triptych::report
