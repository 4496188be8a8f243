#pragma once
// The paper's analysis of one suite's records, whole: what could be computed, and why the rest
// could not. From records alone.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/correlation.hpp"
#include "analysis/distribution.hpp"
#include "analysis/mean_times.hpp"
#include "analysis/observations.hpp"
#include "analysis/prediction.hpp"
#include "analysis/views.hpp"

namespace triptych::analysis {

struct LeftOut {
  std::string analysis, reason;
};

struct Request {
  std::map<std::string, std::string> references;  // of speed-ups: factor → level
  std::uint64_t seed = 1;                         // of everything that draws
};

struct SuiteAnalysis {
  Dataset dataset;
  std::vector<Distribution> distributions;
  std::vector<Matrix> matrices;  // one per factor with at least two levels that share pairs
  std::vector<Box> boxes;        // of the same
  std::vector<MeanTimes> mean_times;
  std::vector<SpeedUp> speed_ups;  // relative to Request::references, else to the first level
  std::optional<Prediction> prediction;
  std::vector<PathTest> path_tests;
  std::vector<Stack> stacks;
  std::vector<LeftOut> left_out;

  [[nodiscard]] bool empty() const;  // nothing could be computed
};

// Throws core::InputError for a reference whose level the factor does not have.
[[nodiscard]] SuiteAnalysis analyze(Dataset dataset, const Request& request);

}  // namespace triptych::analysis
