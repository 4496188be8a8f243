#include "analysis/analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"

namespace triptych::analysis {
namespace {

// The pairs of factors whose mean times are shown: devices, and what the paper's Figures 8 and 14
// set against data.
constexpr std::pair<std::string_view, std::string_view> heat_maps[] = {{"data", "device"},
                                                                       {"data", camera_path},
                                                                       {"data", "technique"},
                                                                       {"technique", "device"},
                                                                       {camera_path, "device"}};

std::string reference_of(const Split& split, const Request& request) {
  const auto asked = request.references.find(split.factor);
  if (asked == request.references.end()) return split.levels.front().name;
  if (std::ranges::find(split.levels, asked->second, &Level::name) != split.levels.end()) {
    return asked->second;
  }
  std::string levels;
  for (const Level& each : split.levels) levels += (levels.empty() ? "" : ", ") + each.name;
  throw core::InputError(fmt::format("reference {}={}: that factor's levels are {}", split.factor,
                                     asked->second, levels));
}

void correlate(SuiteAnalysis& analysis, const Request& request) {
  const std::vector<std::string> factors = factors_of(analysis.dataset);
  for (const std::string& factor : factors) {
    const Split by_factor = split(analysis.dataset, factor);
    const auto lines = speed_ups(by_factor, reference_of(by_factor, request));
    analysis.speed_ups.insert(analysis.speed_ups.end(), lines.begin(), lines.end());
    Matrix matrix = correlations(by_factor);
    if (const auto box = box_of(matrix)) {
      analysis.boxes.push_back(*box);
      analysis.matrices.push_back(std::move(matrix));
    } else {
      analysis.left_out.push_back({"correlation of " + factor,
                                   fmt::format("no two of its {} levels share {} configurations",
                                               matrix.levels.size(), least_pairs)});
    }
  }
  if (factors.empty()) {
    analysis.left_out.push_back({"correlation", "every factor has one level only"});
  }
  for (const auto& [factor, value] : request.references) {
    if (std::ranges::find(factors, factor) == factors.end()) {
      analysis.left_out.push_back({fmt::format("speed-up relative to {}={}", factor, value),
                                   "this suite's records have no such factor with two levels"});
    }
  }
}

void average(SuiteAnalysis& analysis) {
  for (const auto& [rows, columns] : heat_maps) {
    MeanTimes each = mean_times(analysis.dataset, rows, columns);
    if (!each.cells.empty()) {
      analysis.mean_times.push_back(std::move(each));
    } else {
      analysis.left_out.push_back(
          {fmt::format("mean times, {} by {}", rows, columns),
           "one of them has fewer than two levels in any block of comparable configurations"});
    }
  }
}

}  // namespace

bool SuiteAnalysis::empty() const {
  return distributions.empty() && matrices.empty() && mean_times.empty() && speed_ups.empty() &&
         !prediction && path_tests.empty() && stacks.empty();
}

SuiteAnalysis analyze(Dataset dataset, const Request& request) {
  SuiteAnalysis analysis{.dataset = std::move(dataset)};
  analysis.distributions = distributions(analysis.dataset, request.seed);
  if (analysis.distributions.empty()) {
    analysis.left_out.push_back(
        {"distribution",
         fmt::format("{} observations, {} that differ are needed",
                     analysis.dataset.observations.size(), least_for_distribution)});
  }
  correlate(analysis, request);
  average(analysis);
  PredictionOutcome outcome = predict(analysis.dataset, request.seed);
  analysis.prediction = std::move(outcome.prediction);
  if (!analysis.prediction) analysis.left_out.push_back({"prediction", outcome.reason});
  analysis.path_tests = path_tests(analysis.dataset, request.seed);
  if (analysis.path_tests.empty()) {
    analysis.left_out.push_back({"camera paths against all views", "fewer than two paths"});
  }
  analysis.stacks = stacks(analysis.dataset);
  if (analysis.stacks.empty()) {
    analysis.left_out.push_back(
        {"stack of sizes", "no generate:NAME in two sizes that share configurations"});
  }
  return analysis;
}

}  // namespace triptych::analysis
