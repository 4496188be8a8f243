#pragma once
// An error that somebody asks for, and which of a picture's errors is meant by it.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/image.hpp"

namespace triptych::accuracy {

enum class Metric : std::uint8_t {
  rms,      // root mean square over all pixels and channels
  covered,  // the same over the pixels that the limit shows anything in
  p99_9,    // 99.9th percentile of the pixels, each by its largest channel
  max       // the largest
};
inline constexpr std::array all_metrics{Metric::rms, Metric::covered, Metric::p99_9, Metric::max};
// "rms", "covered", "p99.9", "max".
[[nodiscard]] std::string_view name_of(Metric metric);

struct RequestedError {
  double error = 0;
  Metric metric = Metric::rms;
};
// "E" or "E:METRIC". Throws InputError for what is no positive number or no metric.
[[nodiscard]] RequestedError parse_requested_error(std::string_view text);
// The same text; always with its metric.
[[nodiscard]] std::string text_of(const RequestedError& request);

// A picture's errors against its limit.
struct PictureErrors {
  std::array<double, all_metrics.size()> by_metric{};
  std::size_t covered = 0;  // pixels that the limit shows anything in

  [[nodiscard]] double of(Metric metric) const {
    return by_metric[static_cast<std::size_t>(metric)];
  }
};
// Before a background of 0. The error over covered pixels counts what is drawn beside them, too.
// All are NaN for different sizes or values that are not finite.
[[nodiscard]] PictureErrors errors_against(const core::Image& limit, const core::Image& picture);
// The same of a picture in which nothing is drawn.
[[nodiscard]] PictureErrors errors_of_nothing(const core::Image& limit);

}  // namespace triptych::accuracy
