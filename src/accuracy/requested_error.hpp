#pragma once
// A requested error, and the metric that it refers to.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/image.hpp"

namespace triptych::accuracy {

enum class Metric : std::uint8_t {
  rms,      // root mean square over all pixels and channels
  covered,  // root mean square over the pixels in which the limit shows something
  p99_9,    // 99.9th percentile over the pixels of their largest channel error
  max       // the largest difference
};
inline constexpr std::array all_metrics{Metric::rms, Metric::covered, Metric::p99_9, Metric::max};
// The names "rms", "covered", "p99.9" and "max".
[[nodiscard]] std::string_view name_of(Metric metric);

struct RequestedError {
  double error = 0;
  Metric metric = Metric::rms;
};
// Parses "E" or "E:METRIC". Throws InputError if E is not a positive number or METRIC is unknown.
[[nodiscard]] RequestedError parse_requested_error(std::string_view text);
// The text of the request, which always includes the metric.
[[nodiscard]] std::string text_of(const RequestedError& request);

// The errors of an image, measured against its limit.
struct PictureErrors {
  std::array<double, all_metrics.size()> by_metric{};
  std::size_t covered = 0;  // number of pixels in which the limit shows something

  [[nodiscard]] double of(Metric metric) const {
    return by_metric[static_cast<std::size_t>(metric)];
  }
};
// Computes the errors. The images must have a background of 0. The error over covered pixels
// includes everything that an image shows outside of them, too. All errors are NaN if the sizes
// differ or if values are not finite.
[[nodiscard]] PictureErrors errors_against(const core::Image& limit, const core::Image& picture);
// The errors of an image in which nothing is drawn.
[[nodiscard]] PictureErrors errors_of_nothing(const core::Image& limit);

}  // namespace triptych::accuracy
