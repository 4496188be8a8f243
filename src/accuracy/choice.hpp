#pragma once
// The cheapest settings for a requested error: the longest possible step, and the fastest of the
// measured configurations that keep the error.

#include <cstddef>
#include <functional>
#include <optional>
#include <span>

#include "accuracy/accuracy.hpp"

namespace triptych::accuracy {

// The shares of a requested error E: 0.7 for the step and 0.25 for early termination (at
// transmittance ε it removes at most ε of any channel, so ε = E/4). Merged samples may use 1/32,
// because the worthwhile merges are nearly free. In the worst case all errors add up; the rest is
// for rounding and storage.
inline constexpr double step_share = 0.7;
inline constexpr double termination_share = 0.25;
inline constexpr double merging_share = 1.0 / 32;

struct StepLimits {
  double shortest = 1.0 / 64;
  double longest = 4096;
};

using ErrorOfStep = std::function<double(double step)>;

// The longest step, in quarters of an octave, whose error is at most `error` and is still so at
// half the step, because a long step may be right by chance. With an error of second order the
// result is at least 0.7 of `error`. If no step is short enough, the result is the shortest one
// that was tried, with its error. `error_of` is called about ten times.
[[nodiscard]] StepError longest_step(double error, const StepLimits& limits,
                                     const ErrorOfStep& error_of);

// Transfers a step that was found on one image to another: the longest step of at most `step` that
// keeps `error`. It is shortened as for an error of second order, repeatedly, because edges have a
// lower order. If none keeps the error, the result is the shortest step with its error.
[[nodiscard]] StepError shortened_step(double step, double error, const StepLimits& limits,
                                       const ErrorOfStep& error_of);

// The size of the image on which the search runs, for an image of the given size: the same shape,
// at most about 48² pixels, but neither side below eight pixels or its original size. A long image
// becomes a shorter one, not a line.
struct PictureSize {
  int width = 0;
  int height = 0;
};
[[nodiscard]] PictureSize search_size(const PictureSize& picture);

// The time and the error of a measurement.
struct TimedError {
  std::optional<double> time_ns;
  double error = 0;
};
// The fastest with at most this error; nullopt if there is none.
[[nodiscard]] std::optional<std::size_t> cheapest(std::span<const TimedError> cases, double error);

}  // namespace triptych::accuracy
