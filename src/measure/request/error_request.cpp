#include "measure/request/error_request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "accuracy/choice.hpp"
#include "core/error.hpp"
#include "measure/contract/factor.hpp"
#include "measure/request/error_factor.hpp"
#include "measure/request/error_trials.hpp"
#include "measure/request/short_number.hpp"

namespace triptych::measure {
namespace {

using accuracy::StepError;

// The limits of the search if the user fixed the step. The number is a placeholder, because the
// configurations keep the fixed level.
constexpr accuracy::StepLimits fixed_step{1, 1};

// Finds the settings from which the trials of a scene start.
class StartSearch {
 public:
  explicit StartSearch(const ErrorSearch& search)
      : search_(search),
        suite_(search.suite),
        goal_(search.goal),
        limits_{error_factor(suite_, "step").minimum, error_factor(suite_, "step").maximum},
        step_error_(accuracy::step_share * goal_.request.error) {}

  // Adds the settings for the scene that begin() has named, or the reason why there are none.
  void add(const Configuration& scene, std::vector<ErrorStart>& starts,
           std::vector<Unreachable>& unreachable) {
    progress_.scene = scene_of(suite_, scene, goal_);
    const accuracy::LimitImage* limit = search_.truths.limit_of(record_of(scene));
    if (limit == nullptr) {
      unreachable.push_back({.scene = progress_.scene, .why = Unreachable::Why::no_limit_image});
      return;
    }
    const auto empty_image = accuracy::errors_of_empty_image(limit->image);
    const double empty_error = empty_image.of(goal_.request.metric);
    if (empty_error <= goal_.request.error) {
      unreachable.push_back({.scene = progress_.scene,
                             .why = Unreachable::Why::empty_image,
                             .error = empty_error,
                             .covered = empty_image.covered,
                             .pixels = limit->image.pixel_count()});
      return;
    }
    std::optional<StepError> best;
    const std::size_t before = starts.size();
    const std::string small = small_viewport(scene);
    for (const std::string& quadrature : quadratures(scene)) {
      Configuration candidate = scene;
      candidate["quadrature"] = quadrature;
      const accuracy::StepLimits limits = limits_of(candidate);
      progress_.quadrature = quadrature;
      progress_.viewport = small;
      const StepError first = first_step(candidate, limits);
      // The error of a small image is only an estimate of the error of the complete image. However,
      // if it exceeds the step's share of the requested error by more than this factor, it is
      // assumed that the complete image cannot meet the requested error.
      constexpr double rejection_factor = 4;
      const bool fixed = !goal_.chooses("step");
      const bool meets_share = fixed || first.error <= rejection_factor * step_error_;
      if (!fixed) report(ErrorProgress::Phase::step_found, first, meets_share);
      if (meets_share) {
        starts.push_back({.scene = progress_.scene,
                          .configuration = candidate,
                          .search = {goal_.request.error, first.step, limits, thresholds()}});
      }
      if (!best || first.error < best->error) best = first;
    }
    if (starts.size() > before) return;
    unreachable.push_back({.scene = progress_.scene,
                           .why = Unreachable::Why::step,
                           .error = best->error,
                           .allowed = step_error_,
                           .viewport = small});
  }

  void begin(std::size_t scene_number, std::size_t scenes, const Configuration& scene) {
    progress_ = {.scene_number = scene_number,
                 .scenes = scenes,
                 .viewport = scene.at("viewport"),
                 .metric = goal_.request.metric};
    if (scene_number == 1) report(ErrorProgress::Phase::begin);
  }

 private:
  void report(ErrorProgress::Phase phase, const StepError& step = {}, bool meets_share = false) {
    progress_.phase = phase;
    progress_.step = step;
    progress_.meets_share = meets_share;
    search_.report(progress_);
  }

  [[nodiscard]] record::Record record_of(const Configuration& configuration) const {
    record::Record record;
    record.suite = suite_.name();
    record.scene = scene_key(suite_, configuration);
    record.factors = configuration;
    return record;
  }

  // Returns the quadratures to be tried: the fixed one, or all except "own", which is an alias of
  // one of the others.
  [[nodiscard]] std::vector<std::string> quadratures(const Configuration& scene) const {
    if (!goal_.chooses("quadrature")) return {scene.at("quadrature")};
    std::vector<std::string> levels = error_factor(suite_, "quadrature").levels;
    std::erase(levels, "own");
    return levels;
  }

  [[nodiscard]] accuracy::StepLimits limits_of(const Configuration& candidate) const {
    if (!goal_.chooses("step")) return fixed_step;
    // The quadrature `cells` divides a ray into ⌈1/step⌉ parts between two voxel planes, so all
    // steps of 1 or more are equivalent.
    if (candidate.at("quadrature") != "cells") return limits_;
    return {limits_.shortest, std::min(limits_.longest, 1.0)};
  }

  // Returns the thresholds of early ray termination to be tried. The first is the largest that
  // cannot exceed its share of the error. The actual error is usually much smaller, because only a
  // few rays end just below the threshold, so larger thresholds are tried, too.
  [[nodiscard]] std::vector<double> thresholds() const {
    if (!goal_.chooses("ert")) return {0.0};  // a placeholder, like fixed_step
    const Factor& ert = error_factor(suite_, "ert");
    const double safe = accuracy::termination_share * goal_.request.error;
    std::set<double> thresholds;
    for (const double factor : {1.0, 4.0, 16.0}) {
      thresholds.insert(std::clamp(factor * safe, ert.minimum, ert.maximum));
    }
    return {thresholds.begin(), thresholds.end()};
  }

  [[nodiscard]] std::string small_viewport(const Configuration& scene) const {
    const auto [width, height] = parse_viewport(scene.at("viewport"));
    const accuracy::ImageSize size = accuracy::search_size({width, height});
    return fmt::format("{}x{}", size.width, size.height);
  }

  // Returns the longest step with which the small image meets the share of the error. Scenes that
  // differ only in how they are drawn, such as in the technique, share the result.
  [[nodiscard]] StepError first_step(Configuration candidate, const accuracy::StepLimits& limits) {
    if (!goal_.chooses("step")) return {.step = limits.longest};
    candidate["viewport"] = progress_.viewport;
    candidate["step"] = error_factor(suite_, "step").default_value;
    const std::string key = scene_key(suite_, candidate);
    const auto known = first_steps_.find(key);
    if (known != first_steps_.end()) return known->second;
    report(ErrorProgress::Phase::step_search);
    const std::string limit_key = suite_.limit_key(candidate);
    if (limit_key != small_limit_key_) {
      small_limit_ = suite_.limit(candidate).image;
      small_limit_key_ = limit_key;
    }
    const StepError found = accuracy::longest_step(step_error_, limits, [&](double step) {
      candidate["step"] = short_number(step);
      return accuracy::errors_against(small_limit_, suite_.truth(candidate, {}).truth)
          .of(goal_.request.metric);
    });
    return first_steps_[key] = found;
  }

  const ErrorSearch& search_;
  SuiteWithTruth& suite_;
  const ErrorGoal& goal_;
  accuracy::StepLimits limits_;
  double step_error_;
  ErrorProgress progress_;
  core::Image small_limit_;
  std::string small_limit_key_;
  std::map<std::string, StepError> first_steps_;
};

// Adds the configurations to be timed: all that draw the image of `chosen`, and one that merges
// samples, if that is possible.
void add_candidates(const Configuration& chosen, const ErrorSearch& search, Plan& plan) {
  const bool merges_fixed = !search.goal.chooses("adapt");
  if (!search.goal.chooses("skip")) {
    plan.configurations.push_back(chosen);
  } else {
    for (const std::string& skip : error_factor(search.suite, "skip").levels) {
      Configuration candidate = chosen;
      candidate["skip"] = skip;
      const bool can_be_drawn =
          !merges_fixed || skip == "bricks" || as_number(candidate, "adapt") == 0;
      if (can_be_drawn) plan.configurations.push_back(candidate);
    }
  }
  // Samples can be merged only with the quadrature `midpoint` and with skip=bricks.
  const bool can_skip_bricks = search.goal.chooses("skip") || chosen.at("skip") == "bricks";
  if (merges_fixed || chosen.at("quadrature") != "midpoint" || !can_skip_bricks) return;
  Configuration merging = chosen;
  merging["skip"] = "bricks";
  merging["adapt"] = short_number(std::min(accuracy::merging_share * search.goal.request.error,
                                           error_factor(search.suite, "adapt").maximum));
  plan.configurations.push_back(merging);
}

// Sets the levels that are the same for all trials of a scene.
void set_trial_levels(Configuration& scene, const ErrorSearch& search) {
  if (search.goal.chooses("adapt")) scene["adapt"] = "0";
  if (search.goal.chooses("ert")) scene["ert"] = "0";
  if (!search.goal.chooses("skip")) return;
  const bool merges = as_number(scene, "adapt") > 0;
  scene["skip"] = merges ? "bricks" : error_factor(search.suite, "skip").default_value;
}

}  // namespace

ErrorRequest request_error(const Plan& plan, const ErrorSearch& search) {
  if (plan.counted()) {
    throw core::InputError(fmt::format(
        "--error requires a plan that measures frame times, but plan {} counts instructions",
        plan.name));
  }
  // Throws an error for a suite that is not for volumes. Of the factors that the suite lacks, the
  // message should name the most important one.
  static_cast<void>(error_factor(search.suite, "step"));
  ErrorRequest result{.plan = plan, .unreachable = {}};
  result.plan.checks.insert(record::Check::timing);
  result.plan.name = fmt::format("{} within {}", plan.name, text_of(search.goal.request));
  result.plan.configurations.clear();
  result.plan.varied.assign(error_factors.begin(), error_factors.end());
  std::map<std::string, Configuration> scenes;
  std::vector<std::string> order;
  for (Configuration scene : plan.configurations) {
    const std::string name = scene_of(search.suite, scene, search.goal);
    set_trial_levels(scene, search);
    if (!scenes.emplace(name, scene).second) continue;
    if (search.suite.missing_data(scene).empty()) {
      order.push_back(name);
    } else {
      result.plan.configurations.push_back(scene);  // will be reported as skipped
    }
  }
  StartSearch start_search(search);
  std::vector<ErrorStart> starts;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Configuration& scene = scenes.at(order[i]);
    start_search.begin(i + 1, order.size(), scene);
    start_search.add(scene, starts, result.unreachable);
  }
  if (starts.empty()) return result;
  for (const Configuration& chosen : ErrorTrials(result.plan, search, std::move(starts)).run()) {
    add_candidates(chosen, search, result.plan);
  }
  return result;
}

}  // namespace triptych::measure
