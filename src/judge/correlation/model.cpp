#include "judge/correlation/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "judge/correlation/levels.hpp"
#include "judge/correlation/program.hpp"
#include "judge/statistics/statistics.hpp"

namespace triptych::judge {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
using Model = CorrelationModel;

struct Times {
  std::vector<double> a;
  std::vector<double> b;
};

Times log_times(std::span<const CorrelationCase> cases) {
  Times times;
  for (const CorrelationCase& each : cases) {
    if (each.anchor) continue;
    times.a.push_back(each.log_time_a);
    times.b.push_back(each.log_time_b);
  }
  return times;
}

double raw_r(const Times& times) {
  // Relative to the first, so that no exponential overflows; r knows no units.
  std::vector<double> a;
  std::vector<double> b;
  for (std::size_t i = 0; i < times.a.size(); ++i) {
    a.push_back(std::exp(times.a[i] - times.a[0]));
    b.push_back(std::exp(times.b[i] - times.b[0]));
  }
  return pearson_r(a, b);
}

bool has_line(const Times& times) {
  return times.a.size() >= 4 &&
         std::ranges::any_of(times.a, [&](double value) { return value != times.a.front(); });
}

void refuse_counts(Correlation& result) {
  const auto too_few = [&](std::size_t there, std::size_t needed, const char* what) {
    if (there < needed) {
      result.refusals.push_back(fmt::format("{} {}, {} are needed", there, what, needed));
    }
  };
  too_few(result.configurations, Model::least_configurations, "configurations with like clocks");
  too_few(result.anchors, Model::least_anchors, "anchors");
}

// Whether times go together at all; where they do not, that is no matter of how much is slower. Of
// a device by itself it is known, and how much of its times a line explains is the plan's doing.
bool go_together(double rho, bool of_itself) {
  return of_itself || rho >= Model::least_rho;
}

// Why a line cannot judge. Written so that a number that is none is refused.
std::vector<std::string> refusals_of(const RobustLine& fit, double rho, bool of_itself) {
  std::vector<std::string> refusals;
  if (!go_together(rho, of_itself)) {
    refusals.push_back(
        fmt::format("the correlation of ln t is {:.3f}, {} is needed", rho, Model::least_rho));
  }
  const double slope = fit.line.slope;
  if (!(slope >= Model::least_slope && slope <= Model::largest_slope)) {
    refusals.push_back(fmt::format("the slope is {:.3f}, outside {} to {}", slope,
                                   Model::least_slope, Model::largest_slope));
  }
  if (!(fit.scale <= Model::largest_scale)) {
    refusals.push_back(
        fmt::format("the residuals scatter by {:.3f} in ln t, at most {:.2f} "
                    "is allowed",
                    fit.scale, Model::largest_scale));
  }
  return refusals;
}

double typical_scatter(std::span<const CorrelationCase> cases) {
  std::vector<double> variances;
  for (const CorrelationCase& each : cases) {
    if (!each.anchor) variances.push_back(each.variance_a + each.variance_b);
  }
  return median(variances);
}

// Of itself a device's residuals are one run's chance: those of a calm run beside stored ones of
// which each had slow minutes of its own scatter less than the next run will. Those of the day when
// a device was accepted know nothing of today's.
void leave_scatter_of_runs(std::span<const CorrelationCase> cases, RobustLine& fit) {
  if (!(fit.scale > 0)) return;  // an exact line is one
  fit.scale = std::max(fit.scale, std::sqrt(typical_scatter(cases)));
}

// The line that B's times had when it was accepted, with today's residuals from it; nullopt where a
// case was not accepted or that line cannot judge either.
std::optional<RobustLine> line_of_acceptance(std::span<const CorrelationCase> cases) {
  Times known;
  Times now;
  for (const CorrelationCase& each : cases) {
    if (!each.known_log_time_b) return std::nullopt;
    if (each.anchor) continue;
    known.a.push_back(each.log_time_a);
    known.b.push_back(*each.known_log_time_b);
    now.b.push_back(each.log_time_b);
  }
  RobustLine fit = robust_line(known.a, known.b);
  leave_scatter_of_runs(cases, fit);
  if (!refusals_of(fit, pearson_r(known.a, known.b), false).empty()) return std::nullopt;
  fit.line.intercept += change_since_acceptance(cases, true).value_or(0);
  for (std::size_t i = 0; i < now.b.size(); ++i) {
    fit.residuals[i] = now.b[i] - fit.line.at(known.a[i]);
  }
  return fit;
}

double square(double value) {
  return value * value;
}

// Of a configuration's own times.
KnownVariance own_scatter(const CorrelationCase& each) {
  return KnownVariance{each.variance_a, each.degrees_a} +
         KnownVariance{each.variance_b, each.degrees_b};
}

// z and p; what is left is what they mean together.
struct Tested {
  std::vector<double> slower;  // p, of configurations alone
  std::vector<double> faster;
  std::vector<double> errors;
};

Tested test_configurations(std::span<const CorrelationCase> cases, const RobustLine& fit,
                           Correlation& result) {
  const auto degrees = static_cast<double>(result.configurations - 2);
  Tested tested;
  const double typical = typical_scatter(cases);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (cases[i].anchor) continue;
    ConfigurationJudgement& judgement = result.judgements[i];
    KnownVariance more = own_scatter(cases[i]);
    more.variance = std::max(more.variance - typical, 0.0);
    const KnownVariance of_line{square(fit.scale) * (1 + judgement.leverage), degrees};
    const KnownVariance whole = of_line + more;
    tested.errors.push_back(std::sqrt(whole.variance));
    judgement.z = whole.variance > 0
                      ? judgement.residual / tested.errors.back()
                      : std::copysign(judgement.residual == 0 ? 0 : infinite, judgement.residual);
    const double freedom = std::min(whole.degrees, degrees);
    judgement.p = student_t_upper_tail(judgement.z, freedom);
    tested.slower.push_back(judgement.p);
    tested.faster.push_back(student_t_upper_tail(-judgement.z, freedom));
  }
  return tested;
}

void judge_configurations(std::span<const CorrelationCase> cases, const RobustLine& fit,
                          Correlation& result) {
  const Tested tested = test_configurations(cases, fit, result);
  const auto slower_q = benjamini_hochberg_adjusted(tested.slower);
  const auto faster_q = benjamini_hochberg_adjusted(tested.faster);
  const auto device = change_since_acceptance(cases, result.line_of_acceptance);
  const double least = std::log(Model::least_configuration_effect);
  std::size_t next = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (cases[i].anchor) continue;
    ConfigurationJudgement& judgement = result.judgements[i];
    judgement.q = slower_q[next];
    judgement.slower = judgement.q <= Model::share_of_false_alarms && judgement.residual >= least;
    judgement.faster =
        faster_q[next] <= Model::share_of_false_alarms && -judgement.residual >= least;
    judgement.suspected = judgement.q <= Model::share_of_false_suspects &&
                          Model::is_worth_telling(judgement.residual);
    // Beside a change of the device; the line that today's times have takes that of the program
    // too.
    const auto known = cases[i].known_log_time_b;
    judgement.standing = judgement.suspected && known && device &&
                         !Model::is_worth_telling(cases[i].log_time_b - *known - *device);
    ++next;
  }
  const auto degrees = static_cast<double>(result.configurations - 2);
  result.smallest_effect =
      std::max(least, median(tested.errors) * detectable_in_errors(tested.errors.size(), degrees));
}

// Residuals and leverages of all cases; anchors have none of the latter.
void place(std::span<const CorrelationCase> cases, const RobustLine& fit, Correlation& result) {
  double squares = 0;
  std::size_t next = 0;
  for (const CorrelationCase& each : cases) {
    ConfigurationJudgement judgement;
    judgement.residual = each.log_time_b - fit.line.at(each.log_time_a);
    if (!each.anchor) {
      judgement.leverage = fit.leverages[next++];
      judgement.share = square(judgement.residual);
      squares += judgement.share;
    }
    result.judgements.push_back(judgement);
  }
  if (!(squares > 0)) return;
  for (ConfigurationJudgement& judgement : result.judgements) judgement.share /= squares;
}

// The line that configurations and levels are held against.
struct JudgingLine {
  RobustLine fit;
  std::vector<double> offsets;  // of a line beside a level
};

// In place of the line through all, which may be none.
void take_another_line(std::span<const CorrelationCase> cases, bool refused, bool of_itself,
                       JudgingLine& line, Correlation& result) {
  if (refused && !of_itself) {  // whose line of acceptance is y = x, without any scatter
    if (auto accepted = line_of_acceptance(cases)) {
      line.fit = std::move(*accepted);
      result.line_of_acceptance = true;
      return;
    }
  }
  auto beside = line_beside_a_level(cases, line.fit);
  if (beside && of_itself) leave_scatter_of_runs(cases, beside->fit);
  if (!beside || !refusals_of(beside->fit, result.rho, of_itself).empty()) return;
  const double most = refused ? Model::share_beside_level : 1;
  if (!is_level_told(beside->offset, beside->p) || !(beside->fit.scale <= most * line.fit.scale))
    return;
  line = {std::move(beside->fit), std::move(beside->offsets)};
  result.line_beside = std::move(beside->name);
}

}  // namespace

bool CorrelationModel::is_worth_telling(double effect) {
  return effect >= std::log(least_effect);
}

Correlation correlate(std::span<const CorrelationCase> cases, const KnownVariance& beside_anchors,
                      bool of_itself) {
  Correlation result;
  const Times times = log_times(cases);
  result.configurations = times.a.size();
  result.anchors = cases.size() - times.a.size();
  refuse_counts(result);
  if (!has_line(times)) {
    result.judgements.resize(cases.size());
    if (result.admitted()) result.refusals.emplace_back("all times of one device are alike");
    return result;
  }
  JudgingLine line{robust_line(times.a, times.b), {}};
  if (of_itself) leave_scatter_of_runs(cases, line.fit);
  result.r = raw_r(times);
  result.rho = pearson_r(times.a, times.b);
  const auto refusals = refusals_of(line.fit, result.rho, of_itself);
  if (result.admitted() && go_together(result.rho, of_itself)) {
    take_another_line(cases, !refusals.empty(), of_itself, line, result);
  }
  if (!result.line_of_acceptance && result.line_beside.empty()) {
    result.refusals.insert(result.refusals.end(), refusals.begin(), refusals.end());
  }
  const RobustLine& fit = line.fit;
  result.line = fit.line;
  result.intercept_error = fit.intercept_error;
  result.slope_error = fit.slope_error;
  result.scale = fit.scale;
  place(cases, fit, result);
  if (!result.admitted()) return result;
  judge_configurations(cases, fit, result);
  result.levels = level_effects(cases, fit, line.offsets, of_itself);
  judge_program(cases, fit, beside_anchors, result);
  return result;
}

}  // namespace triptych::judge
