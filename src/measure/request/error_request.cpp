#include "measure/request/error_request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "accuracy/choice.hpp"
#include "core/error.hpp"
#include "measure/contract/factor.hpp"
#include "record/factor_list.hpp"

namespace triptych::measure {
namespace {

using accuracy::RequestedError;

constexpr std::array<const char*, 5> chosen_factors{"adapt", "ert", "quadrature", "skip", "step"};

const Factor& factor_of(const Suite& suite, std::string_view name) {
  const auto found = std::ranges::find(suite.factors(), name, &Factor::name);
  if (found == suite.factors().end()) {
    throw core::InputError(
        fmt::format("--error requires the factors step, quadrature, ert, skip and adapt, but "
                    "suite {} has no factor {}",
                    suite.name(), name));
  }
  return *found;
}

// Returns the levels of a factor except "own", which stands for one of the other levels.
std::vector<std::string> levels_of(const Suite& suite, std::string_view name) {
  std::vector<std::string> levels = factor_of(suite, name).levels;
  std::erase(levels, "own");
  return levels;
}

// Returns the name of a scene, "camera=…,data=…". The name does not contain the factors whose
// levels the request chooses.
std::string scene_of(const Suite& suite, Configuration configuration) {
  for (const char* name : chosen_factors)
    configuration[name] = factor_of(suite, name).default_value;
  return configuration_key(suite, configuration);
}

// Rounds down to 9 significant bits, so that the numbers in plans are short.
double rounded_down(double value) {
  const double unit = std::exp2(std::floor(std::log2(value)) - 8);
  return std::floor(value / unit) * unit;
}

std::string text_of_step(double step) {
  return fmt::format("{}", rounded_down(step));
}

// Finds the candidates for the scenes of a plan: configurations that should meet the requested
// error.
class Search {
 public:
  Search(SuiteWithTruth& suite, const RequestedError& request, Truths& truths,
         const std::function<void(const std::string&)>& report)
      : suite_(suite),
        request_(request),
        truths_(truths),
        report_(report),
        limits_{factor_of(suite, "step").minimum, factor_of(suite, "step").maximum},
        step_error_(accuracy::step_share * request.error) {}

  // Adds the candidate configurations for a scene, or the reason why there are none.
  void add(const Configuration& scene, ErrorRequest& result) {
    const std::string name = scene_of(suite_, scene);
    const accuracy::LimitImage* limit = truths_.limit_of(record_of(scene));
    if (limit == nullptr) {
      result.unreachable.push_back(
          name +
          ": a stress scene has no limit image, so no error can be computed; choose other data");
      return;
    }
    const auto empty_image = accuracy::errors_of_empty_image(limit->image);
    if (empty_image.of(request_.metric) <= request_.error) {
      result.unreachable.push_back(fmt::format(
          "{}: an empty image already meets the error limit {}, because its error is {:.3g} and "
          "only {} of {} pixels differ from the background; request a smaller error, another "
          "metric, or a scene that covers more pixels",
          name, text_of(request_), empty_image.of(request_.metric), empty_image.covered,
          limit->image.pixel_count()));
      return;
    }
    prepare_small_image(scene);
    std::optional<StepResult> best;
    const std::size_t before = result.plan.configurations.size();
    for (const std::string& quadrature : levels_of(suite_, "quadrature")) {
      Configuration candidate = scene;
      candidate["quadrature"] = quadrature;
      const StepResult found = longest_step(candidate, limit->image);
      candidate["step"] = text_of_step(found.step);
      const bool meets_limit = found.error <= step_error_;
      report_(
          fmt::format("{}: with quadrature={}, the error caused by the step size is {} "
                      "step={} (error {:.2g}, {})",
                      name, quadrature, meets_limit ? "small enough at" : "too large even at",
                      candidate.at("step"), found.error, name_of(request_.metric)));
      if (meets_limit) add_candidates(candidate, result.plan);
      if (!best || found.error < best->error) best = found;
    }
    if (result.plan.configurations.size() > before) return;
    result.unreachable.push_back(fmt::format(
        "{}: the error caused by the step size may be at most {:.3g}, which is a share of "
        "the requested error {}, but it is larger with every step size; the smallest "
        "error is {:.3g}, at viewport={}",
        name, step_error_, text_of(request_), best->error, best->viewport));
  }

 private:
  // A step size, its error, and the size of the image that was used to compute the error.
  struct StepResult {
    double step = 0;
    double error = 0;
    std::string viewport;
  };

  [[nodiscard]] record::Record record_of(const Configuration& configuration) const {
    record::Record record;
    record.suite = suite_.name();
    record.scene = scene_key(suite_, configuration);
    record.factors = configuration;
    return record;
  }

  [[nodiscard]] double error(const core::Image& limit, const core::Image& image) const {
    return accuracy::errors_against(limit, image).of(request_.metric);
  }

  void prepare_small_image(const Configuration& scene) {
    const auto [width, height] = parse_viewport(scene.at("viewport"));
    const accuracy::ImageSize size = accuracy::search_size({width, height});
    small_viewport_ = fmt::format("{}x{}", size.width, size.height);
    Configuration coarse = scene;
    coarse["viewport"] = small_viewport_;
    small_limit_ = suite_.limit(coarse).image;
  }

  // Returns the longest step with which the candidate's quadrature meets the limit step_error_. The
  // step is first estimated with a small image, and then checked with the complete image.
  [[nodiscard]] StepResult longest_step(Configuration candidate, const core::Image& limit) {
    const std::string viewport = std::exchange(candidate["viewport"], small_viewport_);
    accuracy::StepLimits limits = limits_;
    // The quadrature `cells` divides a ray into ⌈1/step⌉ parts between two voxel planes, so all
    // steps of 1 or more are equivalent.
    if (candidate.at("quadrature") == "cells") limits.longest = std::min(limits.longest, 1.0);
    const accuracy::StepError guess = accuracy::longest_step(step_error_, limits, [&](double step) {
      candidate["step"] = text_of_step(step);
      return error(small_limit_, suite_.truth(candidate, {}).truth);
    });
    // An error computed from a small image is only an estimate. However, if it exceeds the limit
    // step_error_ by more than this factor, the error of the complete image also exceeds that
    // limit.
    constexpr double rejection_factor = 4;
    if (!(guess.error <= rejection_factor * step_error_))
      return {guess.step, guess.error, small_viewport_};
    candidate["viewport"] = viewport;
    const accuracy::StepError found =
        accuracy::shortened_step(guess.step, step_error_, limits, [&](double step) {
          candidate["step"] = text_of_step(step);
          return error(limit, truths_.of(record_of(candidate)).truth);
        });
    return {found.step, found.error, viewport};
  }

  void add_candidates(Configuration candidate, Plan& plan) const {
    const Factor& ert = factor_of(suite_, "ert");
    const double threshold = rounded_down(accuracy::termination_share * request_.error);
    candidate["ert"] = fmt::format("{}", std::clamp(threshold, ert.minimum, ert.maximum));
    for (const std::string& skip : levels_of(suite_, "skip")) {
      candidate["skip"] = skip;
      plan.configurations.push_back(candidate);
    }
    // Adds one more candidate, which merges samples. This is possible only with the quadrature
    // `midpoint` and with skip=bricks.
    if (candidate.at("quadrature") != "midpoint") return;
    const double merged = rounded_down(accuracy::merging_share * request_.error);
    candidate["skip"] = "bricks";
    candidate["adapt"] = fmt::format("{}", std::min(merged, factor_of(suite_, "adapt").maximum));
    plan.configurations.push_back(candidate);
  }

  SuiteWithTruth& suite_;
  RequestedError request_;
  Truths& truths_;
  const std::function<void(const std::string&)>& report_;
  accuracy::StepLimits limits_;
  double step_error_;
  std::string small_viewport_;
  core::Image small_limit_;
};

// The results of one device for a scene.
struct Group {
  std::vector<accuracy::TimedError> cases;
  std::vector<accuracy::ErrorsByMetric> errors;
  std::vector<const record::Record*> records;
  accuracy::ErrorsByMetric empty_image;
};

ErrorAnswer answer_of(const Group& group, const RequestedError& request) {
  ErrorAnswer answer{.empty_image = group.empty_image};
  if (group.cases.empty()) return answer;
  const auto best = accuracy::cheapest(group.cases, request.error);
  const auto nearest = std::ranges::min_element(group.cases, {}, &accuracy::TimedError::error);
  answer.errors =
      group.errors[best.value_or(static_cast<std::size_t>(nearest - group.cases.begin()))];
  if (best) {
    answer.record = group.records[*best];
    answer.time_ns = *group.cases[*best].time_ns;
  }
  return answer;
}

}  // namespace

ErrorRequest request_error(const Plan& plan, SuiteWithTruth& suite, const RequestedError& request,
                           Truths& truths, const std::function<void(const std::string&)>& report) {
  if (plan.counted()) {
    throw core::InputError(fmt::format(
        "--error requires a plan that measures frame times, but plan {} counts instructions",
        plan.name));
  }
  ErrorRequest result{.plan = plan, .unreachable = {}};
  result.plan.checks.insert(record::Check::timing);
  result.plan.name = fmt::format("{} within {}", plan.name, text_of(request));
  result.plan.configurations.clear();
  result.plan.varied.assign(chosen_factors.begin(), chosen_factors.end());
  Search search(suite, request, truths, report);
  std::set<std::string> seen;
  for (Configuration scene : plan.configurations) {
    scene["adapt"] = "0";
    scene["ert"] = "0";
    if (!seen.insert(scene_of(suite, scene)).second) continue;
    if (suite.missing_data(scene).empty()) {
      search.add(scene, result);
    } else {
      result.plan.configurations.push_back(scene);  // will be reported as skipped
    }
  }
  return result;
}

std::vector<ErrorAnswer> answer_error(const std::vector<record::Record>& records,
                                      const Suite& suite, const RequestedError& request,
                                      Truths& truths) {
  std::map<std::pair<std::string, std::string>, Group> groups;
  for (const record::Record& record : records) {
    if (record.outcome == record::Outcome::skipped) continue;
    // Uses the levels that the plan requested. record.factors cannot be used, because it contains
    // resolved levels where the plan has "auto".
    const auto requested = record::parse_factor_list(record.configuration);
    Group& group = groups[{record.device, scene_of(suite, requested)}];
    if (record.outcome != record::Outcome::measured || record.image.empty()) continue;
    const accuracy::LimitImage* limit = truths.limit_of(record);
    if (limit == nullptr) continue;
    const auto errors = accuracy::errors_against(limit->image, truths.image_of(record));
    if (!std::isfinite(errors.of(request.metric))) continue;
    const auto summary = record::summarise(record.time_ns());
    group.cases.push_back(
        {summary ? std::optional(summary->median) : std::nullopt, errors.of(request.metric)});
    group.errors.push_back(errors);
    group.records.push_back(&record);
    group.empty_image = accuracy::errors_of_empty_image(limit->image);
  }
  std::vector<ErrorAnswer> answers;
  for (const auto& [key, group] : groups) {
    answers.push_back(answer_of(group, request));
    answers.back().device = key.first;
    answers.back().scene = key.second;
  }
  return answers;
}

std::string describe(const ErrorAnswer& answer, const RequestedError& request) {
  const double error = answer.errors.of(request.metric);
  const double empty_image = answer.empty_image.of(request.metric);
  if (answer.record == nullptr) {
    const std::string why = empty_image > 0 ? fmt::format("the smallest error is {:.3g}", error)
                                            : std::string("no image was drawn");
    return fmt::format("{} {}: no candidate meets the error limit {}; {}", answer.device,
                       answer.scene, text_of(request), why);
  }
  std::string factors;
  for (const char* name : chosen_factors) {
    factors += fmt::format("{}={}, ", name, answer.record->factors.at(name));
  }
  std::string text = fmt::format(
      "{} {}: {}{:.3f} ms, error {:.3g} (limit {}), {:.2g} % of the error of an empty image",
      answer.device, answer.scene, factors, answer.time_ns / 1e6, error, text_of(request),
      100 * error / empty_image);
  for (const accuracy::Metric metric : accuracy::all_metrics) {
    if (metric == request.metric) continue;
    text += fmt::format(", {} {:.3g}", name_of(metric), answer.errors.of(metric));
  }
  return text;
}

}  // namespace triptych::measure
