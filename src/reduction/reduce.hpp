#pragma once
// Simplifies a failing configuration as long as it still fails, by greedy delta debugging over the
// levels of its factors.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "measure/contract/suite.hpp"
#include "reduction/failure.hpp"

namespace triptych::reduction {

// A function that draws a configuration and returns how it fails. It returns nullopt if the
// configuration does not fail or cannot be drawn.
using Attempt = std::function<std::optional<Failure>(const measure::Configuration&)>;

// The replacement of a level with a simpler level.
struct Step {
  std::string factor;
  std::string from;
  std::string to;
  int frame = 0;  // 1-based number of the frame that failed with the new level
};

struct Reduction {
  measure::Configuration smallest;
  Failure failure;  // the failure of the smallest configuration
  std::vector<Step> steps;
  int frames = 0;        // number of frames drawn
  bool complete = true;  // false if the search reached `most_frames` before finding that no
                         // simpler level of any factor fails in the same way
};

// Reduces `start`, whose failure is `first`. Only configurations that fail in the same way are
// accepted. The result depends only on the results of `attempt`, which is called at most once per
// configuration.
[[nodiscard]] Reduction reduce(const measure::Suite& suite, const measure::Configuration& start,
                               const Failure& first, int most_frames, const Attempt& attempt,
                               const std::function<void(const Step&)>& on_step);

// Returns the first and the last level of each factor that changed, in the suite's order of
// factors.
[[nodiscard]] std::vector<Step> changed_levels(const measure::Suite& suite,
                                               const measure::Configuration& start,
                                               const measure::Configuration& smallest);

}  // namespace triptych::reduction
