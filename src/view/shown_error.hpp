#pragma once
// The difference of a frame from the reference image or from another device, in the form in which
// the window shows it.

#include <string>
#include <vector>

#include "accuracy/truth_pair.hpp"
#include "core/image.hpp"
#include "core/rgb_picture.hpp"

namespace triptych::view {

struct ShownError {
  core::RgbPicture picture;  // errors as shares of the bound, in colour; may be empty
  struct Ring {
    int x;
    int y;
  };
  std::vector<Ring> rings = {};  // around pixels beyond the bound
  int ring_radius = 0;           // in pixels
  bool right = false;            // true if no pixel is beyond the bound
  double share = 0;              // largest error as a share of its pixel's bound
  std::size_t beyond = 0;        // pixels beyond the bound
  std::string headline = {};     // a short line
  std::string sentence = {};     // the complete result in words
};

// `bound` is the bound of `expected`. `other` is the name of the device that drew `expected`; it is
// empty if `expected` is the reference image.
[[nodiscard]] ShownError shown_error(const core::Image& image, const core::Image& expected,
                                     const core::Image& bound, const std::string& other);

// The largest difference that two correct images may have. Each differs from its reference image by
// at most its bound, so the images differ by at most the sum of both bounds and of the difference
// of the two reference images. If a particle is certain in both, it must be the same in both.
// Throws InputError if the sizes differ.
[[nodiscard]] core::Image bound_between(const accuracy::TruthPair& a, const accuracy::TruthPair& b);

// The colours for shares from 0 to just beyond the bound, from left to right.
[[nodiscard]] core::RgbPicture scale_of_bounds(int width);

}  // namespace triptych::view
