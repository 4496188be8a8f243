#include "analysis/mean_times.hpp"

#include <array>
#include <map>
#include <set>
#include <utility>

#include "estimation/statistics.hpp"

namespace triptych::analysis {

using estimation::mean;
namespace {

struct Natural {
  bool operator()(const std::pair<std::string, std::string>& a,
                  const std::pair<std::string, std::string>& b) const {
    if (a.first != b.first) return natural_less(a.first, b.first);
    return natural_less(a.second, b.second);
  }
};

}  // namespace

MeanTimes mean_times(const Dataset& dataset, std::string_view rows, std::string_view columns) {
  MeanTimes result{.rows = std::string(rows), .columns = std::string(columns)};
  const std::array factors{rows, columns};
  const Chosen chosen = fullest_block(all_of(dataset), factors);
  std::map<std::pair<std::string, std::string>, std::vector<double>, Natural> times;
  std::set<std::string> row_levels;
  std::set<std::string> column_levels;
  for (const Observation* each : chosen) {
    const std::string row = *level_of(*each, rows);
    const std::string column = *level_of(*each, columns);
    times[{row, column}].push_back(each->ms);
    row_levels.insert(row);
    column_levels.insert(column);
  }
  if (row_levels.size() < 2 || column_levels.size() < 2) return result;
  for (const auto& [place, values] : times) {
    result.cells.push_back({place.first, place.second, values.size(), mean(values)});
  }
  result.scope = scope_of(chosen);
  return result;
}

}  // namespace triptych::analysis
