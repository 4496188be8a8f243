#include "app/error_request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "accuracy/cases.hpp"
#include "accuracy/choice.hpp"
#include "accuracy/image_metrics.hpp"
#include "core/error.hpp"
#include "core/image_io.hpp"
#include "measure/contract/factor.hpp"

namespace triptych::app {
namespace {

constexpr std::array<const char*, 5> chosen_factors{"adapt", "ert", "quadrature", "skip", "step"};

const measure::Factor& factor_of(const measure::Suite& suite, std::string_view name) {
  const auto found = std::ranges::find(suite.factors(), name, &measure::Factor::name);
  if (found == suite.factors().end()) {
    throw core::InputError(
        fmt::format("--error chooses step, quadrature, ert, skip and adapt; suite {} has no {}",
                    suite.name(), name));
  }
  return *found;
}

// Its levels but for the one by which data bring their own: it stands for another of them.
std::vector<std::string> levels_of(const measure::Suite& suite, std::string_view name) {
  std::vector<std::string> levels = factor_of(suite, name).levels;
  std::erase(levels, "own");
  return levels;
}

// "camera=…,data=…" of all that the request leaves as it is.
std::string scene_of(const measure::Suite& suite, measure::Configuration configuration) {
  for (const char* name : chosen_factors) configuration[name] = factor_of(suite, name).standard;
  return measure::configuration_key(suite, configuration);
}

// The same view with fewer pixels.
std::string coarse_viewport(std::string_view viewport) {
  constexpr double longest = 48;
  const auto [width, height] = measure::parse_viewport(viewport);
  const double scale = std::min(longest / std::max(width, height), 1.0);
  const auto pixels = [scale](int n) { return std::max(1, static_cast<int>(n * scale)); };
  return fmt::format("{}x{}", pixels(width), pixels(height));
}

// No more digits than the text of a plan needs, and never more than the value.
double rounded_down(double value) {
  const double unit = std::exp2(std::floor(std::log2(value)) - 8);
  return std::floor(value / unit) * unit;
}

}  // namespace

measure::Plan plan_within_error(const measure::Plan& plan, measure::SuiteWithTruth& suite,
                                double error, const std::function<void(const std::string&)>& tell) {
  if (!(error > 0) || !std::isfinite(error)) {
    throw core::InputError(fmt::format("--error {}: expected a positive number", error));
  }
  const measure::Factor& steps = factor_of(suite, "step");
  const measure::Factor& ert = factor_of(suite, "ert");
  const double enough =
      std::clamp(rounded_down(accuracy::termination_share * error), ert.minimum, ert.maximum);
  const double merged =
      std::min(rounded_down(accuracy::merging_share * error), factor_of(suite, "adapt").maximum);
  measure::Plan request = plan;
  request.name = fmt::format("{} within {}", plan.name, error);
  request.configurations.clear();
  request.varied.assign(chosen_factors.begin(), chosen_factors.end());
  std::set<std::string> seen;
  for (measure::Configuration candidate : plan.configurations) {
    candidate["adapt"] = "0";
    if (!seen.insert(scene_of(suite, candidate)).second) continue;
    if (!suite.missing_data(candidate).empty()) {
      request.configurations.push_back(candidate);  // told of as skipped when it is measured
      continue;
    }
    measure::Configuration coarse = candidate;
    coarse["viewport"] = coarse_viewport(candidate.at("viewport"));
    coarse["ert"] = "0";
    const core::Image limit = suite.limit(coarse).image;
    bool any = false;
    for (const std::string& quadrature : levels_of(suite, "quadrature")) {
      coarse["quadrature"] = quadrature;
      const auto found = accuracy::longest_step(
          accuracy::step_share * error, {steps.minimum, steps.maximum}, [&](double step) {
            coarse["step"] = fmt::format("{}", rounded_down(step));
            return accuracy::root_mean_square(suite.truth(coarse, {}).image, limit);
          });
      if (!found) {
        tell(fmt::format("{}: no {} step is short enough", scene_of(suite, candidate), quadrature));
        continue;
      }
      any = true;
      candidate["quadrature"] = quadrature;
      candidate["step"] = fmt::format("{}", rounded_down(found->step));
      candidate["ert"] = fmt::format("{}", enough);
      tell(fmt::format("{}: {} keeps it with step {}, which errs by {:.2g}",
                       scene_of(suite, candidate), quadrature, candidate.at("step"), found->error));
      for (const std::string& skip : levels_of(suite, "skip")) {
        candidate["skip"] = skip;
        request.configurations.push_back(candidate);
      }
      if (quadrature != "midpoint") continue;  // no other has samples to merge, nor any other skip
      candidate["skip"] = "bricks";
      candidate["adapt"] = fmt::format("{}", merged);
      request.configurations.push_back(candidate);
      candidate["adapt"] = "0";
    }
    if (!any) {
      throw core::InputError(fmt::format("--error {}: no step of {} is short enough", error,
                                         scene_of(suite, candidate)));
    }
  }
  return request;
}

std::vector<ErrorAnswer> answer_error(const std::vector<record::Record>& records,
                                      const measure::Suite& suite, Truths& truths, double error) {
  struct Group {
    std::vector<accuracy::AccuracyCase> cases;
    std::vector<const record::Record*> records;
  };
  std::map<std::pair<std::string, std::string>, Group> groups;
  for (const record::Record& record : records) {
    if (record.outcome != record::Outcome::measured || record.image.empty()) continue;
    const accuracy::LimitPicture* limit = truths.limit_of(record);
    if (limit == nullptr) continue;
    const core::Image picture = truths.picture_of(record);
    const auto found = accuracy::picture_error(picture, truths.of(record).truth, limit->image);
    if (!found) continue;
    Group& group = groups[{record.device, scene_of(suite, record.factors)}];
    group.cases.push_back(accuracy::accuracy_case(record, *found));
    group.records.push_back(&record);
  }
  std::vector<ErrorAnswer> answers;
  for (const auto& [key, group] : groups) {
    ErrorAnswer answer{.device = key.first, .scene = key.second};
    const auto best = accuracy::cheapest(group.cases, error);
    const std::size_t shown = best.value_or(accuracy::most_accurate(group.cases));
    answer.rmse = group.cases[shown].rmse;
    if (best) {
      answer.record = group.records[*best];
      answer.time_ns = *group.cases[*best].time_ns;
    }
    answers.push_back(std::move(answer));
  }
  return answers;
}

std::string describe(const ErrorAnswer& answer, double error) {
  if (answer.record == nullptr) {
    return fmt::format("{} {}: no candidate keeps {}; the least error is {:.3g}", answer.device,
                       answer.scene, error, answer.rmse);
  }
  std::string factors;
  for (const char* name : chosen_factors) {
    factors +=
        fmt::format("{}{}={}", factors.empty() ? "" : " ", name, answer.record->factors.at(name));
  }
  return fmt::format("{} {}: {}, {:.3f} ms, error {:.3g} of {}", answer.device, answer.scene,
                     factors, answer.time_ns / 1e6, answer.rmse, error);
}

}  // namespace triptych::app
