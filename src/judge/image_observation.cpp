#include "judge/image_observation.hpp"

namespace triptych::judge {
namespace {

Cause cause_of(const accuracy::ImageComparison& comparison) {
  if (comparison.size_mismatch) return Cause::size_differs;
  if (comparison.non_finite > 0) return Cause::not_finite;
  if (comparison.over_bound > 0) return Cause::pixels_over_bound;
  if (comparison.wrong_ids + comparison.wrong_depths > 0) return Cause::other_surface;
  return comparison.pixels == 0 ? Cause::empty_image : Cause::within_bound;
}

void add_sizes(Observation& what, const core::Image& image, const core::Image& expected) {
  set_number(what, "width", image.width);
  set_number(what, "height", image.height);
  set_number(what, "expected_width", expected.width);
  set_number(what, "expected_height", expected.height);
}

void add_surface(Observation& what, const accuracy::ImageComparison::Surface& first) {
  set_number(what, "x", first.x);
  set_number(what, "y", first.y);
  if (first.id != core::Image::no_particle) set_number(what, "particle", first.id);
  if (first.expected_id != core::Image::no_particle) {
    set_number(what, "expected_particle", first.expected_id);
  }
  set_number(what, "depth", first.depth);
  set_number(what, "expected_depth", first.expected_depth);
  set_number(what, "depth_bound", first.bound);
}

// Adds the rectangle that contains all wrong pixels if it is at most half as large as the image.
void add_place(Observation& what, const accuracy::ImageComparison& comparison) {
  const auto& [left, top, right, bottom] = comparison.wrong;
  const double area = (right - left + 1.0) * (bottom - top + 1.0);
  if (left < 0 || 2 * area > static_cast<double>(comparison.pixels)) return;
  set_number(what, "wrong_left", left);
  set_number(what, "wrong_top", top);
  set_number(what, "wrong_right", right);
  set_number(what, "wrong_bottom", bottom);
}

}  // namespace

Observation image_observation(const accuracy::ImageComparison& comparison, const core::Image& image,
                              const core::Image& expected, Against against) {
  Observation what{.cause = cause_of(comparison), .against = against};
  if (what.cause == Cause::size_differs) {
    add_sizes(what, image, expected);
    return what;
  }
  set_number(what, "pixels", static_cast<double>(comparison.pixels));
  set_number(what, "max_error", comparison.largest.error);
  set_number(what, "error", comparison.worst.error);
  set_number(what, "bound", comparison.worst.bound);
  set_number(what, "ratio", comparison.worst.ratio);
  set_number(what, "x", comparison.worst.x);
  set_number(what, "y", comparison.worst.y);
  set_number(what, "rmse", comparison.rmse);
  set_number(what, "error_99", comparison.error_99);
  set_number(what, "pixels_over", static_cast<double>(comparison.over_bound));
  set_number(what, "pixels_not_finite", static_cast<double>(comparison.non_finite));
  set_number(what, "pixels_of_another_particle", static_cast<double>(comparison.wrong_ids));
  set_number(what, "pixels_at_another_depth", static_cast<double>(comparison.wrong_depths));
  set_number(what, "pixels_not_drawn", static_cast<double>(comparison.not_drawn));
  add_place(what, comparison);
  if (what.cause == Cause::other_surface) add_surface(what, comparison.first_wrong);
  return what;
}

}  // namespace triptych::judge
