#pragma once
// Numbers that compare two pictures. Values only: writing files and messages is the caller's.

#include <cstddef>
#include <cstdint>

#include "core/image.hpp"

namespace triptych::accuracy {

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

  // A pixel that shows another particle, or the right one at another depth.
  struct Surface {
    int x = -1;  // -1: there is none
    int y = -1;
    std::uint32_t id = core::Image::no_particle;
    std::uint32_t expected_id = core::Image::no_particle;
    double depth = 0;
    double expected_depth = 0;
    double bound = 0;  // of the depth
  };

  bool size_mismatch = false;  // then nothing below is filled in
  std::size_t pixels = 0;
  std::size_t non_finite = 0;
  std::size_t over_bound = 0;
  Place worst;          // of the largest ratio
  Place largest;        // of the largest error
  double rmse = 0;      // over all channels of the pixels compared
  double error_99 = 0;  // 99th percentile of the pixels' errors
  // Of particle pictures; 0 for others.
  std::size_t wrong_ids = 0;
  std::size_t wrong_depths = 0;
  Surface first_wrong;

  [[nodiscard]] bool within_bound() const {
    return !size_mismatch && non_finite == 0 && over_bound == 0 && wrong_ids == 0 &&
           wrong_depths == 0 && pixels > 0;
  }
};

// `slack` is added to every bound of a colour. All three images must be of one size, and all or
// none of them particle pictures, else size_mismatch. Where the truth carries ids, the id must be
// the truth's in every pixel whose id in `bound` is 0, and the depth within the bound's depth of
// the truth's; no surface at all is as far as no surface.
[[nodiscard]] ImageComparison compare(const core::Image& image, const core::Image& truth,
                                      const core::Image& bound, double slack = 0);

// The same against one bound for every pixel.
[[nodiscard]] ImageComparison compare(const core::Image& image, const core::Image& truth,
                                      double bound);

// Root of the mean square difference over all channels; NaN for different sizes or values that are
// not finite. Where `bound` carries ids, only over the pixels whose id must be right: at the edge
// of a sphere two right pictures may differ by a whole colour.
[[nodiscard]] double root_mean_square(const core::Image& a, const core::Image& b,
                                      const core::Image& bound = {});

// |a − b|·gain per colour channel, opaque, for looking; NaN (shown as magenta) where either is not
// finite. Throws InputError for different sizes.
[[nodiscard]] core::Image difference_image(const core::Image& a, const core::Image& b, double gain);

}  // namespace triptych::accuracy
