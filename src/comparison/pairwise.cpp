#include "comparison/pairwise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "estimation/statistics.hpp"

namespace triptych::comparison {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

double upper_tail(double z) {
  return estimation::student_t_upper_tail(z, infinite);
}

// The ranks of values by their distance from 0, and the sum that corrects the variance for ties:
// the sum of t³ − t over all groups of t equal values. The ranks are doubled, so that the mean
// ranks of ties are integers.
struct Ranks {
  std::vector<std::size_t> doubled;  // smallest distance first
  std::size_t doubled_statistic = 0;
  double ties = 0;
};

Ranks rank(std::vector<double> values) {
  std::ranges::sort(values, {}, [](double value) { return std::abs(value); });
  Ranks ranks;
  for (std::size_t first = 0; first < values.size();) {
    std::size_t end = first + 1;
    while (end < values.size() && std::abs(values[end]) == std::abs(values[first])) ++end;
    const std::size_t shared = first + 1 + end;  // twice the mean of first + 1 … end
    for (std::size_t i = first; i < end; ++i) {
      ranks.doubled.push_back(shared);
      if (values[i] > 0) ranks.doubled_statistic += shared;
    }
    const auto t = static_cast<double>(end - first);
    ranks.ties += t * t * t - t;
    first = end;
  }
  return ranks;
}

// Returns P(sum = s) for s = 0, 1, …, where each rank is included in the sum with probability ½.
std::vector<double> null_distribution(std::span<const std::size_t> ranks) {
  std::vector<double> share{1};
  for (const std::size_t rank : ranks) {
    std::vector<double> next(share.size() + rank, 0.0);
    for (std::size_t sum = 0; sum < share.size(); ++sum) {
      next[sum] += share[sum] / 2;
      next[sum + rank] += share[sum] / 2;
    }
    share = std::move(next);
  }
  return share;
}

double mean_statistic(double n) {
  return n * (n + 1) / 4;
}
double statistic_variance(double n, double ties) {
  return n * (n + 1) * (2 * n + 1) / 24 - ties / 48;
}

// The confidence interval extends from the k-th smallest to the k-th largest Walsh average (mean of
// two differences). Returns k. For distinct differences, this is the largest k with P(V ≤ k − 1) ≤
// tail, or 0 if there is no such k, where V is the signed-rank statistic of n differences.
std::size_t averages_outside(std::size_t n, double tail) {
  if (n > max_exact_differences) {
    const auto count = static_cast<double>(n);
    const double k = std::floor(mean_statistic(count) + 0.5 -
                                estimation::student_t_upper_quantile(tail, infinite) *
                                    std::sqrt(statistic_variance(count, 0)));
    return k > 0 ? static_cast<std::size_t>(k) : 0;
  }
  std::vector<std::size_t> ranks;
  for (std::size_t i = 1; i <= n; ++i) ranks.push_back(i);
  double below = 0;
  std::size_t k = 0;
  for (const double share : null_distribution(ranks)) {
    below += share;
    if (below > tail) break;
    ++k;
  }
  return k;
}

// The smallest variance of ln(frame time) that is assumed between process runs (lifetimes of worker
// processes): (10⁻⁶)². No clock resolves a millionth of the duration of a batch, so a smaller
// variance would be an artefact of the timers.
constexpr double min_variance = 1e-12;

PairVerdict unconfirmed(const Interval& interval, const SequentialDesign& design) {
  const bool same = interval.low > -design.detectable && interval.high < design.detectable;
  return same ? PairVerdict::same : PairVerdict::undecided;
}

}  // namespace

SignedRank wilcoxon_signed_rank(std::span<const double> differences, double shift) {
  std::vector<double> moved;
  for (const double difference : differences) {
    if (difference != shift) moved.push_back(difference - shift);
  }
  const Ranks ranks = rank(std::move(moved));
  SignedRank result;
  result.n = ranks.doubled.size();
  result.statistic = static_cast<double>(ranks.doubled_statistic) / 2;
  if (result.n == 0) return result;
  if (result.n <= max_exact_differences) {
    const std::vector<double> share = null_distribution(ranks.doubled);
    result.p_less = result.p_greater = 0;
    for (std::size_t sum = 0; sum < share.size(); ++sum) {
      if (sum <= ranks.doubled_statistic) result.p_less += share[sum];
      if (sum >= ranks.doubled_statistic) result.p_greater += share[sum];
    }
    return result;
  }
  const auto n = static_cast<double>(result.n);
  const double deviation = std::sqrt(statistic_variance(n, ranks.ties));
  const double above = result.statistic - mean_statistic(n);
  result.p_greater = upper_tail((above - 0.5) / deviation);
  result.p_less = upper_tail((-above - 0.5) / deviation);
  return result;
}

Shift estimate_shift(std::span<const double> differences, double tail) {
  const std::size_t n = differences.size();
  if (n == 0) return {not_a_number, {-infinite, infinite}};
  std::vector<double> averages;
  averages.reserve(n * (n + 1) / 2);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i; j < n; ++j) {
      averages.push_back(0.5 * (differences[i] + differences[j]));
    }
  }
  Shift shift{estimation::median(averages), {-infinite, infinite}};
  const std::size_t outside = averages_outside(n, tail);
  if (outside == 0) return shift;
  std::ranges::sort(averages);
  shift.interval = {averages[outside - 1], averages[averages.size() - outside]};
  return shift;
}

std::string_view name_of(PairVerdict verdict) {
  switch (verdict) {
    case PairVerdict::slower:
      return "slower";
    case PairVerdict::faster:
      return "faster";
    case PairVerdict::same:
      return "same";
    case PairVerdict::undecided:
      break;
  }
  return "undecided";
}

SequentialDesign SequentialDesign::standard() {
  return {.tolerated = std::log(1.01), .detectable = std::log(1.03)};
}

int SequentialDesign::next_look(int blocks) const {
  const auto next = std::ranges::upper_bound(looks, blocks);
  return next == looks.end() ? 0 : *next;
}

Look look_at(std::span<const double> differences, const SequentialDesign& design) {
  const double level = design.alpha_of_a_look();
  Look look{.shift = estimate_shift(differences, level)};
  const auto above = [&](double shift) {
    return wilcoxon_signed_rank(differences, shift).p_greater <= level;
  };
  const auto below = [&](double shift) {
    return wilcoxon_signed_rank(differences, shift).p_less <= level;
  };
  if (above(design.tolerated)) {
    look.verdict = PairVerdict::slower;
  } else if (below(-design.tolerated)) {
    look.verdict = PairVerdict::faster;
  } else if (below(design.detectable) && above(-design.detectable)) {
    look.verdict = PairVerdict::same;
  }
  return look;
}

std::vector<Confirmation> confirm(std::span<const Suspect> suspects, double q,
                                  const SequentialDesign& design) {
  std::vector<Confirmation> results(suspects.size());
  std::vector<std::size_t> judged;
  std::vector<double> variances;
  std::vector<double> degrees;
  for (std::size_t i = 0; i < suspects.size(); ++i) {
    results[i].shift = {not_a_number, {-infinite, infinite}};
    const std::vector<double>& process_runs = suspects[i].process_runs;
    if (process_runs.size() < min_process_runs) continue;
    judged.push_back(i);
    variances.push_back(std::max(estimation::sample_variance(process_runs), min_variance));
    degrees.push_back(static_cast<double>(process_runs.size() - 1));
  }
  const estimation::VariancePrior prior = estimation::fit_variance_prior(variances, degrees);
  std::vector<double> p_values;
  for (std::size_t k = 0; k < judged.size(); ++k) {
    const Suspect& suspect = suspects[judged[k]];
    Confirmation& result = results[judged[k]];
    const double degrees_of_freedom = prior.degrees + degrees[k];
    const double error = std::sqrt(estimation::moderated_variance(prior, variances[k], degrees[k]) /
                                   static_cast<double>(suspect.process_runs.size()));
    const double centre = estimation::mean(suspect.process_runs);
    const double half_width = estimation::student_t_upper_quantile(q, degrees_of_freedom) * error;
    const double beyond = (suspect.slower ? centre : -centre) - design.tolerated;
    result.shift = {centre, {centre - half_width, centre + half_width}};
    result.p = estimation::student_t_upper_tail(beyond / error, degrees_of_freedom);
    p_values.push_back(result.p);
  }
  const std::vector<bool> rejected = estimation::benjamini_hochberg(p_values, q);
  for (std::size_t k = 0; k < judged.size(); ++k) {
    Confirmation& result = results[judged[k]];
    const bool slower = suspects[judged[k]].slower;
    const PairVerdict suspected = slower ? PairVerdict::slower : PairVerdict::faster;
    result.verdict = rejected[k] ? suspected : unconfirmed(result.shift.interval, design);
  }
  return results;
}

std::vector<Confirmation> confirm_in_looks(std::vector<Suspect>& suspects,
                                           const ConfirmationDesign& confirmation,
                                           const SequentialDesign& design,
                                           const MeasureProcessRun& run_again) {
  std::vector<Confirmation> results(suspects.size());
  std::vector<std::size_t> open(suspects.size());
  std::iota(open.begin(), open.end(), std::size_t{0});
  bool more = true;
  std::size_t process_runs = 0;
  for (const std::size_t look : confirmation.looks) {
    if (open.empty() || !more) break;
    while (more && process_runs < look) more = run_again(open, ++process_runs, look);
    const auto judged = confirm(suspects, confirmation.q_of_a_look(), design);
    for (const std::size_t i : open) results[i] = judged[i];
    std::erase_if(open,
                  [&](std::size_t i) { return results[i].verdict != PairVerdict::undecided; });
  }
  return results;
}

}  // namespace triptych::comparison
