#pragma once
// Numbers that compare two pictures. Values only: writing files and messages is the caller's.

#include <cstddef>

#include "core/image.hpp"

namespace triptych::judge {

// The error of a pixel is the largest absolute difference of its four channels, in full scale (1 =
// white); its bound belongs to that channel's pixel. Pixels with a value that is not finite, in
// either picture, are counted apart and enter nothing else.
struct ImageComparison {
  struct Place {
    int x = -1;  // -1: no pixel could be compared
    int y = -1;
    double error = 0;
    double bound = 0;
    double ratio = 0;  // error/bound; infinite where the bound is 0 and the error is not
  };

  bool size_mismatch = false;  // then nothing below is filled in
  std::size_t pixels = 0;
  std::size_t non_finite = 0;
  std::size_t over_bound = 0;
  Place worst;          // of the largest ratio
  Place largest;        // of the largest error
  double rmse = 0;      // over all channels of the pixels compared
  double error_99 = 0;  // 99th percentile of the pixels' errors

  [[nodiscard]] bool within_bound() const {
    return !size_mismatch && non_finite == 0 && over_bound == 0 && pixels > 0;
  }
};

// `slack` is added to every bound. All three images must be of one size, else size_mismatch.
[[nodiscard]] ImageComparison compare(const core::Image& image, const core::Image& truth,
                                      const core::Image& bound, double slack = 0);

// The same against one bound for every pixel.
[[nodiscard]] ImageComparison compare(const core::Image& image, const core::Image& truth,
                                      double bound);

// Root of the mean square difference over all channels; NaN for different sizes or values that are
// not finite.
[[nodiscard]] double root_mean_square(const core::Image& a, const core::Image& b);

// Peak signal-to-noise ratio in dB for a peak of 1; infinite for equal pictures.
[[nodiscard]] double psnr(const core::Image& a, const core::Image& b);

// |a − b|·gain per colour channel, opaque, for looking; NaN (shown as magenta) where either is not
// finite. Throws InputError for different sizes.
[[nodiscard]] core::Image difference_image(const core::Image& a, const core::Image& b, double gain);

}  // namespace triptych::judge
