#include "judge/timing/model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "judge/statistics/statistics.hpp"
#include "judge/timing/shift.hpp"

namespace triptych::judge {
namespace {

// One case with the shifts taken out.
struct Levelled {
  std::size_t runs = 0;
  [[nodiscard]] bool is_told() const { return runs >= TimingModel::least_runs; }
  double log_ratio = 0;
  double shift = 0;       // of this run against the stored ones
  KnownVariance scatter;  // of the stored runs
  double variance_of_shift = 0;
};

Levelled level(const TimingCase& timing, const CaseShift& shift) {
  Levelled result;
  const std::vector<double> stored = stored_logarithms(timing, shift);
  result.runs = stored.size();
  if (!result.is_told()) return result;
  result.log_ratio = std::log(timing.median_ns) - shift.now - median(stored);
  result.shift = std::log(timing.median_ns) - median(stored_logarithms(timing)) - result.log_ratio;
  result.scatter = scatter_of(stored);
  result.variance_of_shift = shift.variance;
  return result;
}

// From the cases that are no anchors, whose own scatter the shift has partly taken out.
VariancePrior prior_of(std::span<const TimingCase* const> cases,
                       std::span<const Levelled> levelled) {
  const bool only_anchors = std::ranges::all_of(cases, &TimingCase::anchor);
  std::vector<KnownVariance> scatter;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (!levelled[i].is_told()) continue;
    if (!cases[i]->anchor || only_anchors) scatter.push_back(levelled[i].scatter);
  }
  return fit_variance_prior(scatter);
}

// v_r; 0 where fewer than two cases tell any: one's halves may agree by chance.
double typical_variance_of_rounds(std::span<const TimingCase* const> cases) {
  std::vector<double> variances;
  for (const TimingCase* timing : cases) {
    if (!timing->variance_of_rounds) continue;
    variances.push_back(std::max(*timing->variance_of_rounds, least_timing_variance));
  }
  if (variances.size() < 2) return 0;
  return fit_variance_prior(variances, std::vector<double>(variances.size(), 1)).variance;
}

TimingJudgement judge_case(const TimingCase& timing, const Levelled& values,
                           const VariancePrior& prior, double pooled_degrees, double of_rounds) {
  TimingJudgement result;
  result.baseline_ns = std::exp(median(stored_logarithms(timing)));
  result.runs = values.runs;
  if (!values.is_told()) {
    result.log_ratio = std::log(timing.median_ns / result.baseline_ns);
    result.standard_error = result.half_width = std::numeric_limits<double>::infinity();
    return result;
  }
  const KnownVariance run = moderated(prior, values.scatter);
  // No more freedom than all the data together have.
  result.degrees = std::min(run.degrees, pooled_degrees);
  const double of_runs = variance_of_median_to_mean / static_cast<double>(values.runs);
  result.standard_error = std::sqrt(run.variance * (1 + of_runs) + values.variance_of_shift);
  result.busy_variance = std::max(of_rounds - run.variance, 0.0);
  result.log_ratio = values.log_ratio;
  result.shift = values.shift;
  result.test(timing.tolerance);
  return result;
}

void judge_device(std::span<const TimingCase* const> cases, const DeviceShifts& shifts,
                  std::span<TimingJudgement* const> judgements) {
  std::vector<Levelled> levelled;
  double pooled_degrees = 0;
  for (const TimingCase* timing : cases) {
    levelled.push_back(level(*timing, shifts.of(*timing)));
    pooled_degrees += levelled.back().scatter.degrees;
  }
  const VariancePrior prior = prior_of(cases, levelled);
  const double of_rounds = typical_variance_of_rounds(cases);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    *judgements[i] = judge_case(*cases[i], levelled[i], prior, pooled_degrees, of_rounds);
    judgements[i]->anchors = shifts.anchors();
  }
}

void judge_devices(std::span<const TimingCase> cases, TimingJudgements& result) {
  struct Device {
    std::vector<const TimingCase*> cases;
    std::vector<TimingJudgement*> judgements;
  };
  std::map<std::string, Device> by_name;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    Device& device = by_name[cases[i].device];
    device.cases.push_back(&cases[i]);
    device.judgements.push_back(&result.cases[i]);
  }
  std::vector<DeviceShifts> shifts;
  std::vector<KnownVariance> scatter;
  for (const auto& [name, device] : by_name) {
    scatter.push_back(shifts.emplace_back(device.cases).scatter_of_program());
  }
  const VariancePrior of_all = fit_variance_prior(scatter);
  auto next = shifts.begin();
  for (const auto& [name, device] : by_name) {
    next->judge_program(of_all);
    judge_device(device.cases, *next, device.judgements);
    if (next->program()) result.programs.push_back(*next->program());
    ++next;
  }
}

}  // namespace

std::optional<double> variance_of_rounds(std::span<const double> rounds_ns) {
  if (rounds_ns.size() < 2 || std::ranges::min(rounds_ns) <= 0) return std::nullopt;
  const std::size_t half = (rounds_ns.size() + 1) / 2;
  const double difference =
      std::log(std::ranges::min(rounds_ns.first(half)) / std::ranges::min(rounds_ns.subspan(half)));
  return 0.5 * difference * difference;
}

void TimingTest::test(double tolerance) {
  t = (log_ratio - tolerance) / std::hypot(standard_error, std::sqrt(busy_variance));
  p_slower = student_t_upper_tail(t, degrees);
  p_faster = student_t_upper_tail((-log_ratio - tolerance) / standard_error, degrees);
  half_width = standard_error * student_t_upper_quantile(0.05, degrees);
}

bool TimingTest::too_noisy(double tolerance) const {
  return !(std::max(tolerance, log_ratio) + half_width <= std::log(TimingModel::must_be_told));
}

TimingJudgements judge_timings(std::span<const TimingCase> cases) {
  TimingJudgements result;
  result.cases.resize(cases.size());
  judge_devices(cases, result);
  std::vector<TimingJudgement*> judged;
  std::vector<double> slower;
  std::vector<double> faster;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (cases[i].witness) continue;
    judged.push_back(&result.cases[i]);
    slower.push_back(result.cases[i].p_slower);
    faster.push_back(result.cases[i].p_faster);
  }
  const auto is_slower = benjamini_hochberg(slower, TimingModel::share_of_false_alarms);
  const auto is_faster = benjamini_hochberg(faster, TimingModel::share_of_false_alarms);
  for (std::size_t i = 0; i < judged.size(); ++i) {
    judged[i]->slower = is_slower[i];
    judged[i]->faster = is_faster[i];
  }
  return result;
}

}  // namespace triptych::judge
