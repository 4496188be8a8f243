#pragma once
// A requested error, and the metric with which it is measured.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/image.hpp"

namespace triptych::accuracy {

enum class Metric : std::uint8_t {
  rms,      // root mean square over all pixels and channels
  covered,  // root mean square over the non-background pixels of the limit image (step → 0)
  p99_9,    // 99.9th percentile, over the pixels, of the largest channel error
  max       // largest difference in any pixel and channel
};
inline constexpr std::array all_metrics{Metric::rms, Metric::covered, Metric::p99_9, Metric::max};
// Returns "rms", "covered", "p99.9" or "max".
[[nodiscard]] std::string_view name_of(Metric metric);

struct RequestedError {
  double error = 0;
  Metric metric = Metric::rms;
};
// Parses "E" or "E:METRIC". Throws InputError if E is not a positive number or METRIC is unknown.
[[nodiscard]] RequestedError parse_requested_error(std::string_view text);
// Returns the request as "E:METRIC". The metric is always included.
[[nodiscard]] std::string text_of(const RequestedError& request);

// The errors of an image, measured against its limit image.
struct ErrorsByMetric {
  std::array<double, all_metrics.size()> by_metric{};
  std::size_t covered = 0;  // number of non-background pixels of the limit image

  [[nodiscard]] double of(Metric metric) const {
    return by_metric[static_cast<std::size_t>(metric)];
  }
};
// Computes the errors. The images must have a background of 0. Metric::covered divides by the
// number of covered pixels, but it also includes the errors of all other pixels. All errors are NaN
// if the sizes differ or if a value is not finite.
[[nodiscard]] ErrorsByMetric errors_against(const core::Image& limit, const core::Image& image);
// Returns the errors of an image in which nothing is drawn.
[[nodiscard]] ErrorsByMetric errors_of_empty_image(const core::Image& limit);

}  // namespace triptych::accuracy
