#include "reduction/reduce.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "reduction/simpler_levels.hpp"

namespace triptych::reduction {
namespace {

bool is_valid(const measure::Suite& suite, const measure::Factor& factor,
              const std::string& level) {
  try {
    suite.check(factor, level);
    return true;
  } catch (const core::Error&) {
    return false;
  }
}

// Returns the factors, beginning with the factors that reduce the size of a frame, because all
// later frames are then drawn faster.
std::vector<const measure::Factor*> factors_in_order(const measure::Suite& suite) {
  std::vector<const measure::Factor*> factors;
  for (const measure::Factor& each : suite.factors()) factors.push_back(&each);
  const auto is_size = [](const measure::Factor* factor) {
    return factor->name == "viewport" || factor->name == "data";
  };
  std::stable_partition(factors.begin(), factors.end(), is_size);
  return factors;
}

class Search {
 public:
  Search(const measure::Suite& suite, Reduction& result, int most_frames, const Attempt& attempt,
         const std::function<void(const Step&)>& on_step)
      : suite_(suite),
        result_(result),
        most_frames_(most_frames),
        attempt_(attempt),
        on_step_(on_step) {}

  void run() {
    const std::vector<const measure::Factor*> factors = factors_in_order(suite_);
    const auto shrink = [&](const measure::Factor* factor) { return simplify(*factor); };
    while (std::ranges::count_if(factors, shrink) > 0) {
    }
  }

 private:
  // Simplifies one factor as often as possible. Returns whether its level changed.
  bool simplify(const measure::Factor& factor) {
    bool simplified = false;
    while (simplify_once(factor)) simplified = true;
    return simplified;
  }

  // Replaces the factor's level with the simplest level that still fails. Returns false if there is
  // no such level.
  bool simplify_once(const measure::Factor& factor) {
    const std::string from = result_.smallest.at(factor.name);
    for (const std::string& level : simpler_levels(factor, from)) {
      if (!is_valid(suite_, factor, level)) continue;
      measure::Configuration smaller = result_.smallest;
      smaller[factor.name] = level;
      const std::optional<Failure> failure = try_configuration(smaller);
      if (!failure || !is_same_kind(*failure, result_.failure)) continue;
      result_.smallest = std::move(smaller);
      result_.failure = *failure;
      result_.steps.push_back({factor.name, from, level, result_.frames});
      on_step_(result_.steps.back());
      return true;
    }
    return false;
  }

  std::optional<Failure> try_configuration(const measure::Configuration& configuration) {
    if (const auto known = known_results_.find(configuration); known != known_results_.end())
      return known->second;
    if (result_.frames >= most_frames_) {
      result_.complete = false;
      return std::nullopt;
    }
    ++result_.frames;
    return known_results_.emplace(configuration, attempt_(configuration)).first->second;
  }

  const measure::Suite& suite_;
  Reduction& result_;
  int most_frames_;
  const Attempt& attempt_;
  const std::function<void(const Step&)>& on_step_;
  std::map<measure::Configuration, std::optional<Failure>> known_results_;
};

}  // namespace

Reduction reduce(const measure::Suite& suite, const measure::Configuration& start,
                 const Failure& first, int most_frames, const Attempt& attempt,
                 const std::function<void(const Step&)>& on_step) {
  Reduction result{.smallest = start, .failure = first, .steps = {}};
  Search(suite, result, most_frames, attempt, on_step).run();
  return result;
}

std::vector<Step> changed_levels(const measure::Suite& suite, const measure::Configuration& start,
                                 const measure::Configuration& smallest) {
  std::vector<Step> steps;
  for (const measure::Factor& factor : suite.factors()) {
    const std::string& from = start.at(factor.name);
    const std::string& to = smallest.at(factor.name);
    if (from != to) steps.push_back({factor.name, from, to});
  }
  return steps;
}

}  // namespace triptych::reduction
