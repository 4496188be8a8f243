#pragma once
// Makes a failing configuration smaller as long as it still fails, by greedy delta debugging over
// the levels of its factors.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "measure/contract/suite.hpp"
#include "reduction/failure.hpp"

namespace triptych::reduction {

// A function that draws a configuration and returns how it fails. It returns nullopt if the
// configuration does not fail or cannot be drawn.
using Try = std::function<std::optional<Failure>(const measure::Configuration&)>;

// The replacement of a level with a simpler level.
struct Step {
  std::string factor;
  std::string from;
  std::string to;
  int frame = 0;  // number of the frame that failed with this level, counted from 1
};

struct Reduction {
  measure::Configuration smallest;
  Failure failure;  // the failure of the smallest configuration
  std::vector<Step> steps;
  int frames = 0;        // number of frames drawn
  bool complete = true;  // false if the search reached `most_frames` before it knew that no
                         // simpler level of any factor fails in the same way
};

// Reduces `start`. `first` describes how `start` fails. Every smaller configuration must fail in
// the same way. The result depends only on the results of `attempt`, which is called at most once
// per configuration.
[[nodiscard]] Reduction reduce(const measure::Suite& suite, const measure::Configuration& start,
                               const Failure& first, int most_frames, const Try& attempt,
                               const std::function<void(const Step&)>& on_step);

// Returns, for each factor that changed, its first and its last level, in the suite's order.
[[nodiscard]] std::vector<Step> changes(const measure::Suite& suite,
                                        const measure::Configuration& start,
                                        const measure::Configuration& smallest);

}  // namespace triptych::reduction
