#pragma once
// An analysis as flat tables: the one description that JSON, CSV and the page's figures are made
// of.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/analysis.hpp"
#include "core/json.hpp"

namespace triptych::analysis {

// Every row is an object with a value for each column; null for what is not known. `held` names the
// factors with one value in all samples of the row, `samples` counts observations, `pairs`
// configurations that two levels share.
struct Table {
  std::string name;   // a file name's part: "speed_ups"
  std::string title;  // one line
  std::vector<std::string> columns;
  core::Json rows = core::Json::array();
};

// observations, distributions, percentiles, histograms, correlations, correlation_boxes,
// mean_times, speed_ups, predictions, camera_paths, stacks, duplicates, left_out – those with rows.
[[nodiscard]] std::vector<Table> tables(const SuiteAnalysis& analysis);
// Its rows; an empty array when there is no such table.
[[nodiscard]] core::Json rows_of(const std::vector<Table>& tables, std::string_view name);

// RFC 4180, one header line, "\n" between lines; null is an empty field.
[[nodiscard]] std::string csv(const Table& table);

// {"schema": 1, "suites": [{"suite", "clock", "observations", "notes", "tables": {NAME: [row…]}}]}
[[nodiscard]] core::Json to_json(const std::vector<SuiteAnalysis>& analyses);

}  // namespace triptych::analysis
