#include "judge/timing_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "judge/statistics.hpp"

namespace triptych::judge {
namespace {

// Clocks step, so that identical medians occur; ln s² needs a floor, 1e-6 of the time in s.
constexpr double least_variance = 1e-12;

// Run → how much slower than usual the anchors were in it, in ln t.
struct Shifts {
  std::map<std::string, double> stored;
  double now = 0;
  std::size_t anchors = 0;
};

// One case with the shifts taken out.
struct Levelled {
  double now = 0;
  std::vector<double> stored;
  double centre = 0;
  double variance = 0;
  double degrees = 0;
};

std::vector<double> logarithms(const TimingCase& timing) {
  std::vector<double> result;
  for (const auto& [run, ns] : timing.stored_ns) result.push_back(std::log(ns));
  return result;
}

Shifts shifts_of(std::span<const TimingCase* const> cases) {
  std::map<std::string, std::vector<double>> deviations;
  std::vector<double> now;
  for (const TimingCase* timing : cases) {
    if (!timing->anchor) continue;
    const double centre = mean(logarithms(*timing));
    for (const auto& [run, ns] : timing->stored_ns)
      deviations[run].push_back(std::log(ns) - centre);
    now.push_back(std::log(timing->median_ns) - centre);
  }
  Shifts shifts;
  shifts.anchors = now.size();
  if (now.empty()) return shifts;
  shifts.now = median(now);
  for (const auto& [run, values] : deviations) shifts.stored[run] = median(values);
  return shifts;
}

Levelled level(const TimingCase& timing, const Shifts& shifts) {
  Levelled result;
  result.now = std::log(timing.median_ns) - shifts.now;
  for (const auto& [run, ns] : timing.stored_ns) {
    const auto shift = shifts.stored.find(run);
    result.stored.push_back(std::log(ns) - (shift == shifts.stored.end() ? 0 : shift->second));
  }
  result.centre = mean(result.stored);
  result.variance = std::max(sample_variance(result.stored), least_variance);
  result.degrees = static_cast<double>(result.stored.size() - 1);
  return result;
}

// Variance of the shift: of the median of the anchors' deviations, π/2 times that of a mean of as
// many. Several anchors tell their own scatter from what moves them all; of one alone everything is
// scatter.
double shift_variance(std::span<const TimingCase* const> cases, const Shifts& shifts) {
  std::vector<double> variances;
  for (const TimingCase* timing : cases) {
    if (!timing->anchor) continue;
    const std::vector<double> values =
        shifts.anchors > 1 ? level(*timing, shifts).stored : logarithms(*timing);
    variances.push_back(sample_variance(values) * (1 + 1 / static_cast<double>(values.size())));
  }
  if (variances.empty()) return 0;
  const auto count = static_cast<double>(variances.size());
  return count > 1 ? mean(variances) * std::numbers::pi / 2 / (count - 1) : variances.front();
}

// From the cases that are no anchors, whose own scatter the shift has partly taken out.
VariancePrior prior_of(std::span<const TimingCase* const> cases,
                       std::span<const Levelled> levelled) {
  const bool only_anchors = std::ranges::all_of(cases, &TimingCase::anchor);
  std::vector<double> variances;
  std::vector<double> degrees;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (cases[i]->anchor && !only_anchors) continue;
    variances.push_back(levelled[i].variance);
    degrees.push_back(levelled[i].degrees);
  }
  return fit_variance_prior(variances, degrees);
}

TimingJudgement judge_case(const TimingCase& timing, const Levelled& values,
                           const VariancePrior& prior, double pooled_degrees,
                           double variance_of_shift) {
  TimingJudgement result;
  const auto runs = static_cast<double>(values.stored.size());
  const double variance = moderated_variance(prior, values.variance, values.degrees);
  // No more freedom than all the data together have.
  result.degrees = std::min(prior.degrees + values.degrees, pooled_degrees);
  result.standard_error = std::sqrt(variance * (1 + 1 / runs) + variance_of_shift);
  result.baseline_ns = std::exp(mean(logarithms(timing)));
  result.log_ratio = values.now - values.centre;
  result.t = (result.log_ratio - timing.tolerance) / result.standard_error;
  result.p_slower = student_t_upper_tail(result.t, result.degrees);
  result.p_faster = student_t_upper_tail(
      (-result.log_ratio - timing.tolerance) / result.standard_error, result.degrees);
  result.half_width = result.standard_error * student_t_upper_quantile(0.05, result.degrees);
  return result;
}

void judge_device(std::span<const TimingCase* const> cases,
                  std::span<TimingJudgement* const> judgements) {
  const Shifts shifts = shifts_of(cases);
  std::vector<Levelled> levelled;
  double pooled_degrees = 0;
  for (const TimingCase* timing : cases) {
    levelled.push_back(level(*timing, shifts));
    pooled_degrees += levelled.back().degrees;
  }
  const VariancePrior prior = prior_of(cases, levelled);
  const double variance_of_shift = shift_variance(cases, shifts);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    *judgements[i] = judge_case(*cases[i], levelled[i], prior, pooled_degrees, variance_of_shift);
    judgements[i]->shift = shifts.now;
    judgements[i]->anchors = shifts.anchors;
  }
}

}  // namespace

bool TimingJudgement::too_noisy(double tolerance) const {
  return !(std::max(tolerance, log_ratio) + half_width <= std::log(TimingModel::must_be_told));
}

std::vector<TimingJudgement> judge_timings(std::span<const TimingCase> cases) {
  std::vector<TimingJudgement> judgements(cases.size());
  std::map<std::string, std::vector<std::size_t>> by_device;
  for (std::size_t i = 0; i < cases.size(); ++i) by_device[cases[i].device].push_back(i);
  for (const auto& [device, indexes] : by_device) {
    std::vector<const TimingCase*> own;
    std::vector<TimingJudgement*> results;
    for (const std::size_t i : indexes) {
      own.push_back(&cases[i]);
      results.push_back(&judgements[i]);
    }
    judge_device(own, results);
  }
  std::vector<TimingJudgement*> judged;
  std::vector<double> slower;
  std::vector<double> faster;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (cases[i].witness) continue;
    judged.push_back(&judgements[i]);
    slower.push_back(judgements[i].p_slower);
    faster.push_back(judgements[i].p_faster);
  }
  const auto is_slower = benjamini_hochberg(slower, TimingModel::share_of_false_alarms);
  const auto is_faster = benjamini_hochberg(faster, TimingModel::share_of_false_alarms);
  for (std::size_t i = 0; i < judged.size(); ++i) {
    judged[i]->slower = is_slower[i];
    judged[i]->faster = is_faster[i];
  }
  return judgements;
}

}  // namespace triptych::judge
