#pragma once
// Compares two images numerically. Callers are responsible for writing files and messages.

#include <cstddef>
#include <cstdint>

#include "core/image.hpp"

namespace triptych::accuracy {

// The error of a pixel is the largest absolute difference in any of its four channels, where 1 is
// full scale. This error is compared with the bound for the same pixel and channel. Pixels that
// contain a value that is not finite, in either image, are counted separately and excluded from
// everything else.
struct ImageComparison {
  struct PixelError {
    int x = -1;  // -1 if no pixel could be compared
    int y = -1;
    double error = 0;
    double bound = 0;
    double ratio = 0;  // error/bound; infinite if the bound is 0 and the error is not
  };

  // A pixel that shows a wrong particle, or the correct particle at a wrong depth.
  struct SurfaceError {
    int x = -1;  // -1 if there is no such pixel
    int y = -1;
    std::uint32_t id = core::Image::no_particle;
    std::uint32_t expected_id = core::Image::no_particle;
    double depth = 0;
    double expected_depth = 0;
    double bound = 0;  // bound on the depth error
  };

  // The smallest rectangle that contains all wrong pixels: those with a value that is not finite,
  // an error beyond the bound, a wrong particle or a wrong depth.
  struct Rectangle {
    int left = -1;  // the first column; -1 if no pixel is wrong
    int top = -1;   // the first row
    int right = -1;
    int bottom = -1;
  };

  bool size_mismatch = false;  // if true, the members below are not set
  std::size_t pixels = 0;
  std::size_t non_finite = 0;
  // Pixels of the image that are NaN in all channels. They were probably not drawn, because
  // Triptych sets all outputs to NaN before each frame.
  std::size_t not_drawn = 0;
  std::size_t over_bound = 0;
  PixelError worst;     // pixel with the largest ratio
  PixelError largest;   // pixel with the largest error
  double rmse = 0;      // root mean square error over all channels of the compared pixels
  double error_99 = 0;  // 99th percentile of the pixels' errors
  // Results for images of particles; 0 for other images.
  std::size_t wrong_ids = 0;
  std::size_t wrong_depths = 0;
  SurfaceError first_wrong;
  Rectangle wrong_area;

  [[nodiscard]] bool within_bound() const {
    return !size_mismatch && non_finite == 0 && over_bound == 0 && wrong_ids == 0 &&
           wrong_depths == 0 && pixels > 0;
  }
};

// Compares an image with its reference image. `slack` is added to every colour bound. All three
// images must have the same size, and either all or none of them must be particle images; otherwise
// size_mismatch is set. If the reference image has ids, every pixel whose id is certain, which
// means that bound.ids is 0, must have the id of the reference image and a depth within the depth
// bound. Two pixels without a surface have equal depths.
[[nodiscard]] ImageComparison compare(const core::Image& image, const core::Image& truth,
                                      const core::Image& bound, double slack = 0);

// Compares an image with its reference image, using the same bound for all pixels.
[[nodiscard]] ImageComparison compare(const core::Image& image, const core::Image& truth,
                                      double bound);

// Returns the root mean square difference over all channels, or NaN if the sizes differ or a value
// is not finite. If `bound` has ids, only pixels whose id is certain are compared, because two
// correct images may have completely different colours at the edge of a sphere.
[[nodiscard]] double root_mean_square(const core::Image& a, const core::Image& b,
                                      const core::Image& bound = {});

}  // namespace triptych::accuracy
