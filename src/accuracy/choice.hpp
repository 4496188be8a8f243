#pragma once
// The cheapest way to a requested error: how far a step may be lengthened, and which of what was
// measured is the fastest that keeps it.

#include <functional>
#include <optional>
#include <span>

#include "accuracy/accuracy.hpp"

namespace triptych::accuracy {

// Of a requested error E, root mean square, the step may take 0.7 and early termination 0.25: at
// transmittance ε it takes at most ε of any channel, so ε = E/4. Merged samples may take a
// thirty-second, as what pays is nearly free. All lie the same way in the worst case; what is left
// is for rounding, storage and for what a coarse picture does not tell of a fine one.
inline constexpr double step_share = 0.7;
inline constexpr double termination_share = 0.25;
inline constexpr double merging_share = 1.0 / 32;

struct StepLimits {
  double shortest = 1.0 / 64;
  double longest = 4096;
};

// The longest step, in quarters of an octave, whose error is at most `error`, and which stays so at
// half of it – a long step may hit the right value by chance. With an error of second order it is
// then at least 0.7 of what was asked for: never undercut by more than a step must be. nullopt
// where the shortest step is not enough. `error_of` is called some ten times.
[[nodiscard]] std::optional<StepError> longest_step(double error, const StepLimits& limits,
                                                    const std::function<double(double)>& error_of);

// The fastest case whose root mean square error is at most `error`; nullopt where none is.
[[nodiscard]] std::optional<std::size_t> cheapest(std::span<const AccuracyCase> cases,
                                                  double error);

}  // namespace triptych::accuracy
