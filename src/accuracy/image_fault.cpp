#include "accuracy/image_fault.hpp"

#include <fmt/format.h>

namespace triptych::accuracy {
namespace {

std::string particle_name(std::uint32_t id) {
  return id == core::Image::no_particle ? "none" : fmt::format("particle {}", id);
}

std::string describe_surfaces(const ImageComparison& comparison, std::string_view name) {
  const ImageComparison::Surface& first = comparison.first_wrong;
  return fmt::format(
      "{} of {} pixels show another particle than {}, {} more the right one at another depth; "
      "first at pixel ({}, {}): {} at depth {:.6g}, expected {} at {:.6g} ± {:.3g}",
      comparison.wrong_ids, comparison.pixels, name, comparison.wrong_depths, first.x, first.y,
      particle_name(first.id), first.depth, particle_name(first.expected_id), first.expected_depth,
      first.bound);
}

}  // namespace

std::string describe(const ImageComparison& comparison) {
  const ImageComparison::Place& worst = comparison.worst;
  return fmt::format(
      "largest error {:.3g}, RMSE {:.3g}; worst at pixel ({}, {}): error {:.3g}, bound {:.3g}",
      comparison.largest.error, comparison.rmse, worst.x, worst.y, worst.error, worst.bound);
}

std::string image_fault(const ImageComparison& comparison, const core::Image& image,
                        const core::Image& expected, std::string_view name) {
  if (comparison.size_mismatch) {
    return fmt::format("{}x{} pixels where {} has {}x{}", image.width, image.height, name,
                       expected.width, expected.height);
  }
  if (comparison.non_finite > 0) {
    return fmt::format("{} of {} pixels are not finite against {}", comparison.non_finite,
                       comparison.pixels, name);
  }
  if (comparison.over_bound > 0) {
    const std::string ids = comparison.wrong_ids == 0
                                ? ""
                                : fmt::format("{} show another particle; ", comparison.wrong_ids);
    return fmt::format("{} of {} pixels are over the bound against {}; {}{}", comparison.over_bound,
                       comparison.pixels, name, ids, describe(comparison));
  }
  if (comparison.wrong_ids + comparison.wrong_depths > 0) {
    return describe_surfaces(comparison, name);
  }
  return comparison.pixels == 0 ? std::string("the picture is empty") : std::string();
}

}  // namespace triptych::accuracy
