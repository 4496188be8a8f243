#include "reduction/reduce.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "reduction/plainer.hpp"

namespace triptych::reduction {
namespace {

bool is_taken(const measure::Suite& suite, const measure::Factor& factor,
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
std::vector<const measure::Factor*> in_order(const measure::Suite& suite) {
  std::vector<const measure::Factor*> factors;
  for (const measure::Factor& each : suite.factors()) factors.push_back(&each);
  const auto makes_small = [](const measure::Factor* factor) {
    return factor->name == "viewport" || factor->name == "data";
  };
  std::stable_partition(factors.begin(), factors.end(), makes_small);
  return factors;
}

class Search {
 public:
  Search(const measure::Suite& suite, Reduction& result, int most_frames, const Try& attempt,
         const std::function<void(const Step&)>& on_step)
      : suite_(suite),
        result_(result),
        most_frames_(most_frames),
        attempt_(attempt),
        on_step_(on_step) {}

  void run() {
    const std::vector<const measure::Factor*> factors = in_order(suite_);
    const auto shrink = [&](const measure::Factor* factor) { return make_plainer(*factor); };
    while (std::ranges::count_if(factors, shrink) > 0) {
    }
  }

 private:
  // Simplifies one factor as often as possible. Returns whether its level changed.
  bool make_plainer(const measure::Factor& factor) {
    bool any = false;
    while (take_first(factor)) any = true;
    return any;
  }

  // Replaces the factor's level with the simplest level that still fails. Returns false if there is
  // no such level.
  bool take_first(const measure::Factor& factor) {
    const std::string from = result_.smallest.at(factor.name);
    for (const std::string& level : plainer(factor, from)) {
      if (!is_taken(suite_, factor, level)) continue;
      measure::Configuration smaller = result_.smallest;
      smaller[factor.name] = level;
      const std::optional<Failure> failure = ask(smaller);
      if (!failure || !is_same_kind(*failure, result_.failure)) continue;
      result_.smallest = std::move(smaller);
      result_.failure = *failure;
      result_.steps.push_back({factor.name, from, level, result_.frames});
      on_step_(result_.steps.back());
      return true;
    }
    return false;
  }

  std::optional<Failure> ask(const measure::Configuration& configuration) {
    if (const auto known = asked_.find(configuration); known != asked_.end()) return known->second;
    if (result_.frames >= most_frames_) {
      result_.complete = false;
      return std::nullopt;
    }
    ++result_.frames;
    return asked_.emplace(configuration, attempt_(configuration)).first->second;
  }

  const measure::Suite& suite_;
  Reduction& result_;
  int most_frames_;
  const Try& attempt_;
  const std::function<void(const Step&)>& on_step_;
  std::map<measure::Configuration, std::optional<Failure>> asked_;
};

}  // namespace

Reduction reduce(const measure::Suite& suite, const measure::Configuration& start,
                 const Failure& first, int most_frames, const Try& attempt,
                 const std::function<void(const Step&)>& on_step) {
  Reduction result{.smallest = start, .failure = first, .steps = {}};
  Search(suite, result, most_frames, attempt, on_step).run();
  return result;
}

std::vector<Step> changes(const measure::Suite& suite, const measure::Configuration& start,
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
