#pragma once
// Finds the cheapest settings for a requested error: the longest possible step, and the fastest
// measured configuration that does not exceed the error.

#include <cstddef>
#include <functional>
#include <optional>
#include <span>

#include "accuracy/accuracy.hpp"

namespace triptych::accuracy {

// How a search for a requested error E begins: with a step whose error is at most 0.7 E, and with
// early termination at a transmittance of at most E/4, which changes any channel by at most E/4.
// The actual errors are usually smaller, so BudgetSearch (error_budget.hpp) then tries longer steps
// and earlier termination. Merging neighbouring samples into one may cause an error of E/32. A
// larger share would save little time, because merging saves time mainly in regions in which it
// causes almost no error.
inline constexpr double step_share = 0.7;
inline constexpr double termination_share = 0.25;
inline constexpr double merging_share = 1.0 / 32;

struct StepLimits {
  double shortest = 1.0 / 64;
  double longest = 4096;
};

using ErrorOfStep = std::function<double(double step)>;

// Finds the longest step, to within a factor of 2^(1/4), whose error is at most `error`. The
// error at half this step must also be at most `error`, because the error of a long step may be
// small by chance. If the error is of second order (proportional to step²), the error of the result
// is at least 0.7 of `error`. If no step is short enough, the result is the shortest step that was
// tried, with its error. `error_of` is called about ten times.
[[nodiscard]] StepError longest_step(double error, const StepLimits& limits,
                                     const ErrorOfStep& error_of);

// The size of the image on which the search runs, for an image of the given size. It has the same
// aspect ratio and at most about 48² pixels, but each side has at least eight pixels or its
// original size. A long, narrow image is therefore shortened, but not reduced to a line.
struct ImageSize {
  int width = 0;
  int height = 0;
};
[[nodiscard]] ImageSize search_size(const ImageSize& image);

// The time and the error of a measurement.
struct TimedError {
  std::optional<double> time_ns;
  double error = 0;
};
// Returns the index of the fastest case with at most this error, or nullopt if there is none.
[[nodiscard]] std::optional<std::size_t> cheapest(std::span<const TimedError> cases, double error);

}  // namespace triptych::accuracy
