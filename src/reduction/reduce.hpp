#pragma once
// A configuration that fails, made smaller while it still fails: greedy delta debugging over the
// levels of its factors.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "measure/contract/suite.hpp"
#include "reduction/failure.hpp"

namespace triptych::reduction {

// Draws a configuration and says how it fails; nothing: it does not, or cannot be drawn.
using Try = std::function<std::optional<Failure>(const measure::Configuration&)>;

// A level that a plainer one took the place of.
struct Step {
  std::string factor;
  std::string from;
  std::string to;
  int frame = 0;  // that showed it, from 1
};

struct Reduction {
  measure::Configuration smallest;
  Failure failure;  // of the smallest
  std::vector<Step> steps;
  int frames = 0;        // drawn
  bool complete = true;  // no plainer level of any factor fails so; else it ended at its limit
};

// `first`: how `start` fails. A smaller one has to fail by the same kind. The same answers of
// `attempt` give the same result; none is asked for twice.
[[nodiscard]] Reduction reduce(const measure::Suite& suite, const measure::Configuration& start,
                               const Failure& first, int most_frames, const Try& attempt,
                               const std::function<void(const Step&)>& on_step);

// Of each factor that changed, in the suite's order: its first level and its last.
[[nodiscard]] std::vector<Step> changes(const measure::Suite& suite,
                                        const measure::Configuration& start,
                                        const measure::Configuration& smallest);

}  // namespace triptych::reduction
