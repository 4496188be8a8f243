#pragma once
// The cheapest way to a requested error: how far a step may be lengthened, and which of what was
// measured is the fastest that keeps it.

#include <cstddef>
#include <functional>
#include <optional>
#include <span>

#include "accuracy/accuracy.hpp"

namespace triptych::accuracy {

// Of a requested error E the step may take 0.7 and early termination 0.25: at transmittance ε it
// takes at most ε of any channel, so ε = E/4. Merged samples may take a thirty-second, as what pays
// is nearly free. All lie the same way in the worst case; what is left is for rounding and storage.
inline constexpr double step_share = 0.7;
inline constexpr double termination_share = 0.25;
inline constexpr double merging_share = 1.0 / 32;

struct StepLimits {
  double shortest = 1.0 / 64;
  double longest = 4096;
};

using ErrorOfStep = std::function<double(double step)>;

// The longest step, in quarters of an octave, whose error is at most `error`, and which stays so at
// half of it – a long step may hit the right value by chance. With an error of second order it is
// then at least 0.7 of what was asked for: never undercut by more than a step must be. Where none
// is short enough, the shortest that was tried, with its error. `error_of` is called some ten
// times.
[[nodiscard]] StepError longest_step(double error, const StepLimits& limits,
                                     const ErrorOfStep& error_of);

// What was found on one picture, on another: the longest step of at most `step` that keeps `error`,
// shortened as an error of second order asks for – until then, for edges are of lower order. Where
// none does, the shortest there is, with its error.
[[nodiscard]] StepError shortened_step(double step, double error, const StepLimits& limits,
                                       const ErrorOfStep& error_of);

// Of a picture of that size one that is searched on: of its shape and at most about 48² pixels, but
// neither side below eight pixels or what it has. A long picture becomes a shorter one, not a line.
struct PictureSize {
  int width = 0;
  int height = 0;
};
[[nodiscard]] PictureSize search_size(const PictureSize& picture);

// Something measured, and what it errs by.
struct TimedError {
  std::optional<double> time_ns;
  double error = 0;
};
// The fastest with at most this error; nullopt where none is.
[[nodiscard]] std::optional<std::size_t> cheapest(std::span<const TimedError> cases, double error);

}  // namespace triptych::accuracy
