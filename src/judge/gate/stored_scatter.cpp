#include "judge/gate/stored_scatter.hpp"

#include <cmath>
#include <set>

#include "judge/gate/anchor_run.hpp"

namespace triptych::judge {
namespace {

// Of each run, the deviations of these configurations from their own medians.
using Deviations = std::map<std::string, std::vector<double>>;

Deviations deviations_of(const StoredTimes& stored) {
  Deviations by_run;
  for (const auto& [configuration, runs] : stored) {
    const std::string& clock = runs.back().clock;
    const double centre = median(runs_by(clock, stored, configuration));
    for (const StoredTiming& timing : runs) {
      const auto time = timing.median_by(clock);
      if (time) by_run[timing.run].push_back(std::log(*time) - centre);
    }
  }
  return by_run;
}

}  // namespace

std::vector<double> runs_by(std::string_view clock, const StoredTimes& stored,
                            const std::string& configuration, std::string_view but) {
  std::vector<double> result;
  const auto found = stored.find(configuration);
  if (found == stored.end()) return result;
  for (const StoredTiming& timing : found->second) {
    const auto time = timing.median_by(clock);
    if (time && timing.run != but) result.push_back(std::log(*time));
  }
  return result;
}

VariancePrior scatter_between_runs(const StoredTimes& stored) {
  std::vector<KnownVariance> scatter;
  for (const auto& [configuration, runs] : stored) {
    std::vector<double> logarithms;
    for (const StoredTiming& timing : runs) {
      if (timing.clock == runs.back().clock) logarithms.push_back(std::log(timing.median_ns));
    }
    if (logarithms.size() >= 2) scatter.push_back(scatter_of(logarithms));
  }
  return fit_variance_prior(scatter);
}

KnownVariance variance_of_a_run(const VariancePrior& prior, const std::vector<double>& runs) {
  // As well known as another configuration's lets expect; from a single one alone, hardly at all.
  if (runs.size() < 2) return {prior.variance, prior.degrees > 0 ? prior.degrees : 1};
  return moderated(prior, scatter_of(runs));
}

double share_of_median(std::size_t runs) {
  // Of one or two the median is the mean.
  return (runs < 3 ? 1 : variance_of_median_to_mean) / static_cast<double>(runs);
}

KnownVariance scatter_beside_anchors(const StoredTimes& program, const StoredTimes& anchors,
                                     std::string_view but) {
  constexpr std::size_t least_runs = 3;
  const Deviations of_program = deviations_of(program);
  const Deviations of_anchors = deviations_of(anchors);
  std::set<std::string> anchor_runs;
  for (const auto& [run, deviations] : of_anchors) anchor_runs.insert(run);
  std::vector<double> distances;
  for (const auto& [run, deviations] : of_program) {
    const auto beside = anchors_beside(run, anchor_runs);
    if (run == but || !beside) continue;
    distances.push_back(median(deviations) - median(of_anchors.at(*beside)));
  }
  if (distances.size() < least_runs) return {0, 0};
  return scatter_of(distances);
}

}  // namespace triptych::judge
