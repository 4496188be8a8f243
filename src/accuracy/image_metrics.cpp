#include "accuracy/image_metrics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/nan_pixel.hpp"
#include "record/record.hpp"

namespace triptych::accuracy {
namespace {

bool same_size(const core::Image& a, const core::Image& b) {
  return a.width == b.width && a.height == b.height && a.rgba.size() == b.rgba.size() &&
         a.ids.size() == b.ids.size() && a.depth.size() == b.depth.size();
}

std::span<const float, 4> channels(const core::Image& image, std::size_t pixel) {
  return std::span<const float, 4>(image.rgba.data() + 4 * pixel, 4);
}

bool is_finite(std::span<const float, 4> pixel) {
  return std::ranges::all_of(pixel, [](float v) { return std::isfinite(v); });
}

// Extends the rectangle so that it contains the pixel.
void extend_rectangle(std::size_t pixel, int width, ImageComparison::Rectangle& rectangle) {
  const int x = static_cast<int>(pixel % static_cast<std::size_t>(width));
  const int y = static_cast<int>(pixel / static_cast<std::size_t>(width));
  if (rectangle.left < 0) rectangle = {x, y, x, y};
  rectangle.left = std::min(rectangle.left, x);
  rectangle.right = std::max(rectangle.right, x);
  rectangle.top = std::min(rectangle.top, y);
  rectangle.bottom = std::max(rectangle.bottom, y);
}

double difference(float a, float b) {
  return std::abs(static_cast<double>(a) - static_cast<double>(b));
}

double ratio_of(double error, double bound) {
  if (error == 0) return 0;
  return bound > 0 ? error / bound : std::numeric_limits<double>::infinity();
}

// `bound_at(pixel, channel)` returns the bound. If the bound is NaN, every error exceeds it.
template <typename BoundAt>
ImageComparison compare_with(const core::Image& image, const core::Image& truth,
                             const BoundAt& bound_at) {
  ImageComparison result;
  result.pixels = image.pixel_count();
  std::vector<double> errors;
  errors.reserve(result.pixels);
  double squares = 0;
  for (std::size_t i = 0; i < result.pixels; ++i) {
    const auto drawn = channels(image, i);
    const auto expected = channels(truth, i);
    if (!is_finite(drawn) || !is_finite(expected)) {
      ++result.non_finite;
      if (core::is_nan_pixel(drawn)) ++result.not_drawn;
      extend_rectangle(i, image.width, result.wrong_area);
      continue;
    }
    ImageComparison::PixelError pixel_error{
        static_cast<int>(i % static_cast<std::size_t>(image.width)),
        static_cast<int>(i / static_cast<std::size_t>(image.width))};
    bool is_over_bound = false;
    for (std::size_t c = 0; c < 4; ++c) {
      const double error = difference(drawn[c], expected[c]);
      const double bound = bound_at(i, c);
      squares += error * error;
      is_over_bound = is_over_bound || !(error <= bound);
      if (c == 0 || error > pixel_error.error) {
        pixel_error.error = error;
        pixel_error.bound = bound;
        pixel_error.ratio = ratio_of(error, bound);
      }
    }
    if (is_over_bound) {
      ++result.over_bound;
      extend_rectangle(i, image.width, result.wrong_area);
    }
    if (errors.empty() || pixel_error.ratio > result.worst.ratio) result.worst = pixel_error;
    if (errors.empty() || pixel_error.error > result.largest.error) result.largest = pixel_error;
    errors.push_back(pixel_error.error);
  }
  if (errors.empty()) return result;
  result.rmse = std::sqrt(squares / (4.0 * static_cast<double>(errors.size())));
  result.error_99 = record::percentile(std::move(errors), 0.99);
  return result;
}

// Returns whether the id of this pixel is certain, so that a device must reproduce it.
bool id_is_certain(const core::Image& bound, std::size_t pixel) {
  return bound.ids[pixel] == 0;
}

bool same_depth(double depth, double expected, double bound) {
  return depth == expected || std::abs(depth - expected) <= bound;
}

void compare_surfaces(const core::Image& image, const core::Image& truth, const core::Image& bound,
                      ImageComparison& result) {
  for (std::size_t i = 0; i < truth.ids.size(); ++i) {
    const bool wrong_id = id_is_certain(bound, i) && image.ids[i] != truth.ids[i];
    const bool wrong_depth =
        id_is_certain(bound, i) && !same_depth(image.depth[i], truth.depth[i], bound.depth[i]);
    if (!wrong_id && !wrong_depth) continue;
    extend_rectangle(i, image.width, result.wrong_area);
    if (result.first_wrong.x < 0) {
      const auto width = static_cast<std::size_t>(image.width);
      result.first_wrong = {.x = static_cast<int>(i % width),
                            .y = static_cast<int>(i / width),
                            .id = image.ids[i],
                            .expected_id = truth.ids[i],
                            .depth = image.depth[i],
                            .expected_depth = truth.depth[i],
                            .bound = bound.depth[i]};
    }
    ++(wrong_id ? result.wrong_ids : result.wrong_depths);
  }
}

}  // namespace

ImageComparison compare(const core::Image& image, const core::Image& truth,
                        const core::Image& bound, double slack) {
  if (!same_size(image, truth) || !same_size(image, bound)) return {.size_mismatch = true};
  ImageComparison result = compare_with(image, truth, [&](std::size_t pixel, std::size_t channel) {
    return static_cast<double>(bound.rgba[4 * pixel + channel]) + slack;
  });
  compare_surfaces(image, truth, bound, result);
  return result;
}

ImageComparison compare(const core::Image& image, const core::Image& truth, double bound) {
  if (!same_size(image, truth)) return {.size_mismatch = true};
  return compare_with(image, truth, [bound](std::size_t, std::size_t) { return bound; });
}

double root_mean_square(const core::Image& a, const core::Image& b, const core::Image& bound) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (!same_size(a, b) || a.rgba.empty()) return none;
  double squares = 0;
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < a.pixel_count(); ++i) {
    if (!bound.ids.empty() && !id_is_certain(bound, i)) continue;
    ++pixels;
    for (std::size_t c = 0; c < 4; ++c) {
      const double error = difference(a.rgba[4 * i + c], b.rgba[4 * i + c]);
      squares += error * error;
    }
  }
  const double mean = squares / (4.0 * static_cast<double>(pixels));
  return std::isfinite(mean) ? std::sqrt(mean) : none;
}

}  // namespace triptych::accuracy
