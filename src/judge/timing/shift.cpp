#include "judge/timing/shift.hpp"

#include <algorithm>
#include <cmath>

#include "judge/statistics/statistics.hpp"

namespace triptych::judge {
namespace {

double median_of_sorted(std::span<const double> sorted) {
  return 0.5 * (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]);
}

// Of another run from the median of these, over the variance of one.
double prediction(std::size_t runs) {
  return 1 + variance_of_median_to_mean / static_cast<double>(runs);
}

}  // namespace

std::vector<double> stored_logarithms(const TimingCase& timing, const CaseShift& shift) {
  std::vector<double> result;
  for (const auto& [run, ns] : timing.stored_ns) {
    const auto own = shift.stored.find(run);
    if (own != shift.stored.end()) {
      result.push_back(std::log(ns) - own->second);
    } else if (shift.stored.empty()) {
      result.push_back(std::log(ns));
    }
  }
  return result;
}

void DeviceShifts::Witness::add(const TimingCase& timing) {
  const double centre = median(stored_logarithms(timing));
  for (const auto& [run, ns] : timing.stored_ns) {
    stored[run].emplace_back(std::log(ns) - centre, &timing);
  }
  now.emplace_back(std::log(timing.median_ns) - centre, &timing);
}

void DeviceShifts::Witness::sort() {
  const auto by_value = [](const auto& each) { return each.first; };
  for (auto& [run, deviations] : stored) std::ranges::stable_sort(deviations, {}, by_value);
  std::ranges::stable_sort(now, {}, by_value);
}

DeviceShifts::DeviceShifts(std::span<const TimingCase* const> cases) {
  for (const TimingCase* timing : cases) (timing->anchor ? anchors_ : body_).add(*timing);
  if (anchors_.now.empty()) return;
  anchors_.sort();
  body_.sort();
  by_anchors_ = medians(anchors_, nullptr);
  by_anchors_.variance = scatter_of_anchors();
  if (body_.now.size() < TimingModel::least_body) return;
  by_body_ = medians(body_, nullptr);
  for (const auto& [run, shift] : by_anchors_.stored) {
    const auto of_body = by_body_.stored.find(run);
    if (of_body == by_body_.stored.end()) continue;
    distances_.push_back(of_body->second - shift);
    anchor_shifts_.push_back(shift);
  }
}

std::vector<double> DeviceShifts::without(const Deviations& deviations,
                                          const TimingCase* left_out) {
  std::vector<double> values;
  values.reserve(deviations.size());
  for (const auto& [value, timing] : deviations) {
    if (timing != left_out) values.push_back(value);
  }
  return values;
}

CaseShift DeviceShifts::medians(const Witness& witness, const TimingCase* left_out) {
  CaseShift result;
  for (const auto& [run, deviations] : witness.stored) {
    const std::vector<double> values = without(deviations, left_out);
    if (!values.empty()) result.stored[run] = median_of_sorted(values);
  }
  result.now = median_of_sorted(without(witness.now, left_out));
  return result;
}

// v_a. Several anchors tell their own scatter from what moves them all, which takes one of them; of
// one alone everything is scatter.
double DeviceShifts::scatter_of_anchors() const {
  std::vector<double> scales;
  for (const auto& [value, timing] : anchors_.now) {
    const std::vector<double> values =
        anchors() > 1 ? stored_logarithms(*timing, by_anchors_) : stored_logarithms(*timing);
    const double variance = robust_variance(values) * prediction(values.size());
    scales.push_back(std::sqrt(std::max(variance, least_timing_variance)));
  }
  if (scales.size() == 1) return scales.front() * scales.front();
  const double typical = median(scales);
  double density = 0;
  for (const double scale : scales) density += 1 / std::max(scale, typical);
  const auto count = static_cast<double>(scales.size());
  return variance_of_median_to_mean * count / (density * density) * count / (count - 1);
}

double DeviceShifts::scatter_of_body() const {
  std::vector<KnownVariance> scatter;
  for (const auto& [value, timing] : body_.now) {
    const std::vector<double> levelled = stored_logarithms(*timing, medians(body_, timing));
    if (levelled.size() >= 2) scatter.push_back(scatter_of(levelled));
  }
  return fit_variance_prior(scatter).variance;
}

// v_b
double DeviceShifts::variance_of_body(const TimingCase* left_out) const {
  const std::vector<double> values = without(body_.now, left_out);
  const double expected = variance_of_median_to_mean * typical_scatter_ *
                          prediction(body_.stored.size()) / static_cast<double>(values.size());
  return std::max(expected, variance_of_median(values));
}

KnownVariance DeviceShifts::scatter_of_program() const {
  return distances_.size() < TimingModel::least_runs ? KnownVariance{0, 0} : scatter_of(distances_);
}

void DeviceShifts::judge_program(const VariancePrior& others) {
  const KnownVariance own = scatter_of_program();
  if (own.degrees == 0) return;
  typical_scatter_ = scatter_of_body();
  const KnownVariance among = moderated(others, own);
  const double seen = among.variance * prediction(distances_.size());
  const auto anchors = static_cast<double>(anchors_.now.size());
  ProgramJudgement program;
  program.device = body_.now.front().second->device;
  program.configurations = body_.now.size();
  program.anchors = anchors_.now.size();
  program.degrees =
      seen >= by_anchors_.variance ? among.degrees : std::max(anchors - 1, 1.0) * own.degrees;
  by_anchors_.variance = std::max(by_anchors_.variance, seen);
  program.device_shift = by_anchors_.now - median(anchor_shifts_);
  program.log_ratio = by_body_.now - by_anchors_.now - median(distances_);
  program.standard_error = std::sqrt(by_anchors_.variance + variance_of_body(nullptr));
  std::vector<double> tolerances;
  for (const auto& [value, timing] : body_.now) tolerances.push_back(timing->tolerance);
  program.tolerance = median(tolerances);
  program.test(program.tolerance);
  program.slower = program.p_slower <= TimingModel::false_program_alarms;
  program.faster = program.p_faster <= TimingModel::false_program_alarms;
  program_ = program;
}

CaseShift DeviceShifts::of(const TimingCase& timing) const {
  if (!program_ || program_->slower || program_->faster) return by_anchors_;
  const double of_anchors = by_anchors_.variance;
  const double of_body = variance_of_body(&timing);
  const double weight = of_anchors / (of_anchors + of_body);
  CaseShift shift = medians(body_, &timing);
  const auto mix = [weight](double& body, double anchors) {
    body = weight * body + (1 - weight) * anchors;
  };
  mix(shift.now, by_anchors_.now);
  // A run without anchors has the body's word alone.
  for (auto& [run, value] : shift.stored) {
    const auto own = by_anchors_.stored.find(run);
    if (own != by_anchors_.stored.end()) mix(value, own->second);
  }
  shift.variance = weight * weight * of_body + (1 - weight) * (1 - weight) * of_anchors;
  return shift;
}

}  // namespace triptych::judge
