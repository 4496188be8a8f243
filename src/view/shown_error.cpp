#include "view/shown_error.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "accuracy/image_metrics.hpp"
#include "core/error.hpp"
#include "judge/image_observation.hpp"
#include "report/figures/share_of_bound.hpp"
#include "report/words/finding.hpp"

namespace triptych::view {
namespace {

// Returns the bound on the difference between two correct images in one value of a pixel, rounded
// up. It is the sum of the images' own bounds, `a` and `b`, and the difference between their
// reference values. Two equal infinities, such as two depths without a surface, have the difference
// 0.
float sum_of_bounds(float a, float b, float truth_a, float truth_b) {
  const double distance =
      truth_a == truth_b ? 0
                         : std::abs(static_cast<double>(truth_a) - static_cast<double>(truth_b));
  const double sum = static_cast<double>(a) + static_cast<double>(b) + distance;
  return std::nextafter(static_cast<float>(sum), std::numeric_limits<float>::infinity());
}

std::string headline_of(const accuracy::ImageComparison& comparison) {
  if (comparison.size_mismatch) return "the image sizes differ";
  if (comparison.within_bound()) {
    return comparison.largest.error == 0
               ? std::string("no difference")
               : fmt::format("errors up to {:.3g} times the bound", comparison.worst.ratio);
  }
  if (comparison.non_finite > 0)
    return fmt::format("{} pixels with non-finite values", comparison.non_finite);
  if (comparison.over_bound > 0) {
    return fmt::format("{} pixel{} beyond the bound", comparison.over_bound,
                       comparison.over_bound == 1 ? "" : "s");
  }
  return fmt::format("{} pixels show a different surface",
                     comparison.wrong_ids + comparison.wrong_depths);
}

std::string sentence_of(const accuracy::ImageComparison& comparison, const core::Image& image,
                        const core::Image& expected, const std::string& other) {
  if (other.empty()) {
    return report::words::text_of(
        judge::image_observation(comparison, image, expected, judge::Against::reference));
  }
  if (comparison.size_mismatch) return fmt::format("the image from {} has a different size", other);
  return fmt::format(
      "{} of {} pixels differ from {} by more than the combined bound of both devices; largest "
      "difference {:.3g} at pixel ({}, {}), RMS difference {:.3g}; the pixel with the largest "
      "ratio of difference to bound is ({}, {}): difference {:.3g}, bound {:.3g}",
      comparison.over_bound, comparison.pixels, other, comparison.largest.error,
      comparison.largest.x, comparison.largest.y, comparison.rmse, comparison.worst.x,
      comparison.worst.y, comparison.worst.error, comparison.worst.bound);
}

}  // namespace

ShownError shown_error(const core::Image& image, const core::Image& expected,
                       const core::Image& bound, const std::string& other) {
  const accuracy::ImageComparison comparison = accuracy::compare(image, expected, bound);
  ShownError error;
  error.right = comparison.within_bound();
  error.share = comparison.worst.ratio;
  error.beyond = comparison.over_bound + comparison.non_finite + comparison.wrong_ids;
  error.headline = headline_of(comparison);
  error.sentence = sentence_of(comparison, image, expected, other);
  if (comparison.size_mismatch) return error;
  const report::ShareOfBound shares = report::share_of_bound(image, expected, bound);
  error.displayed = core::to_srgb(shares.image);
  for (const auto& mark : shares.marks) error.rings.push_back({mark.x, mark.y});
  error.ring_radius = shares.ring_radius;
  return error;
}

core::Image bound_between(const accuracy::TruthPair& a, const accuracy::TruthPair& b) {
  core::Image bound = a.bound;
  if (a.truth.rgba.size() != b.truth.rgba.size() || a.truth.ids.size() != b.truth.ids.size() ||
      a.bound.depth.size() != b.bound.depth.size()) {
    throw core::InputError(
        "the reference images have different sizes, so they have no common bound");
  }
  for (std::size_t i = 0; i < bound.rgba.size(); ++i) {
    bound.rgba[i] =
        sum_of_bounds(a.bound.rgba[i], b.bound.rgba[i], a.truth.rgba[i], b.truth.rgba[i]);
  }
  for (std::size_t i = 0; i < bound.depth.size(); ++i) {
    bound.depth[i] =
        sum_of_bounds(a.bound.depth[i], b.bound.depth[i], a.truth.depth[i], b.truth.depth[i]);
  }
  for (std::size_t i = 0; i < bound.ids.size(); ++i) {
    const bool certain =
        bound.ids[i] == 0 && b.bound.ids[i] == 0 && a.truth.ids[i] == b.truth.ids[i];
    bound.ids[i] = certain ? 0 : 1;
  }
  return bound;
}

core::RgbImage scale_of_bounds(int width) {
  constexpr float most = 1.1F;
  core::Image shares(width, 1);
  core::Image zero(width, 1);
  core::Image one(width, 1);
  for (int x = 0; x < width; ++x) {
    const std::size_t i = 4 * static_cast<std::size_t>(x);
    shares.rgba[i] = most * static_cast<float>(x) / static_cast<float>(width - 1);
    for (std::size_t c = 0; c < 4; ++c) one.rgba[i + c] = 1;
  }
  return core::to_srgb(report::share_of_bound(shares, zero, one).image);
}

}  // namespace triptych::view
