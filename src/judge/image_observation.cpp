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

void add_sizes(Observation& observation, const core::Image& image, const core::Image& expected) {
  set_number(observation, "width", image.width);
  set_number(observation, "height", image.height);
  set_number(observation, "expected_width", expected.width);
  set_number(observation, "expected_height", expected.height);
}

void add_surface(Observation& observation, const accuracy::ImageComparison::SurfaceError& first) {
  set_number(observation, "x", first.x);
  set_number(observation, "y", first.y);
  if (first.id != core::Image::no_particle) set_number(observation, "particle", first.id);
  if (first.expected_id != core::Image::no_particle) {
    set_number(observation, "expected_particle", first.expected_id);
  }
  set_number(observation, "depth", first.depth);
  set_number(observation, "expected_depth", first.expected_depth);
  set_number(observation, "depth_bound", first.bound);
}

// Adds the rectangle that contains all wrong pixels.
void add_place(Observation& observation, const accuracy::ImageComparison& comparison) {
  const auto& [left, top, right, bottom] = comparison.wrong_area;
  if (left < 0) return;
  set_number(observation, "wrong_left", left);
  set_number(observation, "wrong_top", top);
  set_number(observation, "wrong_right", right);
  set_number(observation, "wrong_bottom", bottom);
}

}  // namespace

Observation image_observation(const accuracy::ImageComparison& comparison, const core::Image& image,
                              const core::Image& expected, Against against) {
  Observation observation{.cause = cause_of(comparison), .against = against};
  if (observation.cause == Cause::size_differs) {
    add_sizes(observation, image, expected);
    return observation;
  }
  set_number(observation, "pixels", static_cast<double>(comparison.pixels));
  set_number(observation, "max_error", comparison.largest.error);
  set_number(observation, "max_error_bound", comparison.largest.bound);
  set_number(observation, "max_error_x", comparison.largest.x);
  set_number(observation, "max_error_y", comparison.largest.y);
  set_number(observation, "error", comparison.worst.error);
  set_number(observation, "bound", comparison.worst.bound);
  set_number(observation, "ratio", comparison.worst.ratio);
  set_number(observation, "x", comparison.worst.x);
  set_number(observation, "y", comparison.worst.y);
  set_number(observation, "rmse", comparison.rmse);
  set_number(observation, "error_99", comparison.error_99);
  set_number(observation, "pixels_over", static_cast<double>(comparison.over_bound));
  set_number(observation, "pixels_not_finite", static_cast<double>(comparison.non_finite));
  set_number(observation, "pixels_of_another_particle", static_cast<double>(comparison.wrong_ids));
  set_number(observation, "pixels_at_another_depth", static_cast<double>(comparison.wrong_depths));
  set_number(observation, "pixels_not_drawn", static_cast<double>(comparison.not_drawn));
  add_place(observation, comparison);
  if (observation.cause == Cause::other_surface) add_surface(observation, comparison.first_wrong);
  return observation;
}

}  // namespace triptych::judge
