#include "accuracy/requested_error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "record/record.hpp"

namespace triptych::accuracy {
namespace {

constexpr std::array<std::string_view, all_metrics.size()> names{"rms", "covered", "p99.9", "max"};

Metric parse_metric(std::string_view name, std::string_view text) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) {
    throw core::InputError(fmt::format("--error {}: unknown metric '{}'; expected one of {}", text,
                                       name, fmt::join(names, ", ")));
  }
  return all_metrics[static_cast<std::size_t>(found - names.begin())];
}

}  // namespace

std::string_view name_of(Metric metric) {
  return names[static_cast<std::size_t>(metric)];
}

RequestedError parse_requested_error(std::string_view text) {
  const std::string_view number = text.substr(0, text.find(':'));
  RequestedError request;
  const char* end = number.data() + number.size();
  const auto [stopped, failure] = std::from_chars(number.data(), end, request.error);
  if (failure != std::errc() || stopped != end || !(request.error > 0) ||
      !std::isfinite(request.error)) {
    throw core::InputError(fmt::format(
        "--error {}: expected a positive number, optionally with a metric, as in 1e-3:{}", text,
        names.back()));
  }
  if (number.size() < text.size()) {
    request.metric = parse_metric(text.substr(number.size() + 1), text);
  }
  return request;
}

std::string text_of(const RequestedError& request) {
  return fmt::format("{}:{}", request.error, name_of(request.metric));
}

ErrorsByMetric errors_against(const core::Image& limit, const core::Image& image) {
  ErrorsByMetric errors;
  errors.by_metric.fill(std::numeric_limits<double>::quiet_NaN());
  if (limit.width != image.width || limit.height != image.height || limit.rgba.empty() ||
      limit.rgba.size() != image.rgba.size()) {
    return errors;
  }
  double squares = 0;
  std::vector<double> pixels(limit.pixel_count());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    bool covered = false;
    for (std::size_t c = 4 * i; c < 4 * i + 4; ++c) {
      const double difference =
          std::abs(static_cast<double>(limit.rgba[c]) - static_cast<double>(image.rgba[c]));
      squares += difference * difference;
      pixels[i] = std::max(pixels[i], difference);
      covered = covered || limit.rgba[c] != 0;
    }
    if (covered) ++errors.covered;
  }
  if (!std::isfinite(squares)) return errors;
  const auto root_mean_square_over = [squares](std::size_t count) {
    return squares > 0 ? std::sqrt(squares / (4.0 * static_cast<double>(count))) : 0.0;
  };
  const double largest = *std::ranges::max_element(pixels);
  errors.by_metric = {root_mean_square_over(pixels.size()), root_mean_square_over(errors.covered),
                      record::percentile(std::move(pixels), 0.999), largest};
  return errors;
}

ErrorsByMetric errors_of_empty_image(const core::Image& limit) {
  return errors_against(limit, core::Image(limit.width, limit.height));
}

}  // namespace triptych::accuracy
