#pragma once
// The difference between a frame and the reference image, or between the frames of two devices, as
// shown in the window.

#include <string>
#include <vector>

#include "accuracy/truth_pair.hpp"
#include "core/image.hpp"
#include "core/rgb_image.hpp"

namespace triptych::view {

struct ShownError {
  core::RgbImage displayed;  // errors relative to the bound, colour-coded; may be empty
  struct Ring {
    int x;
    int y;
  };
  std::vector<Ring> rings = {};  // circles around pixels that exceed their bound
  int ring_radius = 0;           // in image pixels
  bool right = false;            // true if no pixel exceeds its bound
  double share = 0;              // largest ratio of a pixel's error to its bound
  std::size_t beyond = 0;        // number of pixels that exceed their bound
  std::string headline = {};     // the result in a few words
  std::string sentence = {};     // the complete result as a sentence
};

// Compares `image` with `expected`. `bound` is the bound of `expected`. `other` is the name of the
// device that drew `expected`, or empty if `expected` is the reference image.
[[nodiscard]] ShownError shown_error(const core::Image& image, const core::Image& expected,
                                     const core::Image& bound, const std::string& other);

// Returns the largest difference that two correct images may have. Each image differs from its
// reference image by at most its bound. Therefore the images differ by at most the sum of both
// bounds and the difference between the two reference images. If both bounds allow only one
// particle in a pixel, and it is the same particle, the images must agree on it. Throws InputError
// if the sizes differ.
[[nodiscard]] core::Image bound_between(const accuracy::TruthPair& a, const accuracy::TruthPair& b);

// Returns an image of the colour scale, from no error on the left to slightly more than the bound
// on the right.
[[nodiscard]] core::RgbImage scale_of_bounds(int width);

}  // namespace triptych::view
