#pragma once
// Makes a failing configuration smaller while it still fails: greedy delta debugging over the
// levels of its factors.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "measure/contract/suite.hpp"
#include "reduction/failure.hpp"

namespace triptych::reduction {

// Draws a configuration and returns how it fails; nullopt if it does not fail or cannot be drawn.
using Try = std::function<std::optional<Failure>(const measure::Configuration&)>;

// The replacement of a level by a simpler one.
struct Step {
  std::string factor;
  std::string from;
  std::string to;
  int frame = 0;  // number of the frame that failed with this level, counted from 1
};

struct Reduction {
  measure::Configuration smallest;
  Failure failure;  // failure of the smallest configuration
  std::vector<Step> steps;
  int frames = 0;        // number of frames drawn
  bool complete = true;  // no simpler level of any factor fails in this way; otherwise the search
                         // reached its limit
};

// `first` describes how `start` fails, and every smaller configuration must fail in the same way.
// The result depends only on the answers of `attempt`, which is called at most once for a
// configuration.
[[nodiscard]] Reduction reduce(const measure::Suite& suite, const measure::Configuration& start,
                               const Failure& first, int most_frames, const Try& attempt,
                               const std::function<void(const Step&)>& on_step);

// For each factor that changed, in the suite's order: its first and its last level.
[[nodiscard]] std::vector<Step> changes(const measure::Suite& suite,
                                        const measure::Configuration& start,
                                        const measure::Configuration& smallest);

}  // namespace triptych::reduction
