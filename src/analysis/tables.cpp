#include "analysis/tables.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace triptych::analysis {
namespace {

using core::Json;

Json optional(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json();
}

void add(Table& table, std::vector<Json> cells) {
  Json row = Json::object();
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    row[table.columns[i]] = std::move(cells.at(i));
  }
  table.rows.push_back(std::move(row));
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& each : names) text += (text.empty() ? "" : ", ") + each;
  return text;
}

Table observations(const SuiteAnalysis& analysis) {
  Table table{"observations", "One row per configuration and device", {}};
  const auto& all = analysis.dataset.observations;
  if (all.empty()) return table;
  for (const auto& [factor, value] : all.front().factors) table.columns.push_back(factor);
  const std::size_t factors = table.columns.size();
  table.columns.insert(table.columns.end(), {"ms", "device_ms", "wall_ms"});
  for (const Observation& each : all) {
    std::vector<Json> cells;
    for (std::size_t i = 0; i < factors; ++i) {
      const auto found = each.factors.find(table.columns[i]);
      cells.push_back(found == each.factors.end() ? Json() : Json(found->second));
    }
    cells.insert(cells.end(), {each.ms, optional(each.device_ms), each.wall_ms});
    add(table, std::move(cells));
  }
  return table;
}

Table distribution_fits(const SuiteAnalysis& analysis) {
  Table table{"distributions",
              "Log-normal fits; ks_p takes the fitted parameters for given and is too large, "
              "lilliefors_p is a parametric bootstrap's",
              {"of", "clock", "samples", "mean_ms", "mu", "sigma", "ks_d", "ks_p", "lilliefors_p",
               "replicates", "held"}};
  for (const Distribution& each : analysis.distributions) {
    add(table,
        {each.of, each.clock, each.scope.samples, each.mean, each.fit.mu, each.fit.sigma, each.ks_d,
         each.ks_p, each.lilliefors_p, each.replicates, text_of(each.scope.held)});
  }
  return table;
}

Table percentiles(const SuiteAnalysis& analysis) {
  Table table{"percentiles",
              "Percentiles of the times",
              {"of", "clock", "samples", "percentile", "ms", "held"}};
  for (const Distribution& each : analysis.distributions) {
    for (const auto& [percent, ms] : each.percentiles) {
      add(table, {each.of, each.clock, each.scope.samples, percent, ms, text_of(each.scope.held)});
    }
  }
  return table;
}

Table histograms(const SuiteAnalysis& analysis) {
  Table table{"histograms",
              "Histograms and what the log-normal fit expects",
              {"of", "clock", "scale", "from_ms", "to_ms", "count", "expected", "samples", "held"}};
  for (const Distribution& each : analysis.distributions) {
    const std::string held = text_of(each.scope.held);
    for (const bool logarithmic : {false, true}) {
      for (const Bin& bin : logarithmic ? each.logarithmic : each.linear) {
        add(table, {each.of, each.clock, logarithmic ? "log10" : "linear", bin.from, bin.to,
                    bin.count, bin.expected, each.scope.samples, held});
      }
    }
  }
  return table;
}

void add_cells(Table& table, const Matrix& matrix) {
  const std::string held = text_of(matrix.scope.held);
  for (const LevelPair& cell : matrix.cells) {
    add(table, {matrix.factor, cell.a, cell.b, cell.pairs, optional(cell.r), held});
  }
}

Table correlation_cells(const SuiteAnalysis& analysis) {
  Table table{"correlations",
              "Pearson's r between the levels of every factor, over the configurations that both "
              "have",
              {"factor", "a", "b", "pairs", "r", "held"}};
  for (const Matrix& matrix : analysis.matrices) add_cells(table, matrix);
  return table;
}

std::string held_of(const SuiteAnalysis& analysis, const std::string& factor) {
  const auto matrix = std::ranges::find(analysis.matrices, factor, &Matrix::factor);
  return matrix == analysis.matrices.end() ? std::string() : text_of(matrix->scope.held);
}

std::vector<Json> box_cells(const Box& box) {
  return {box.levels,
          box.cells,
          box.samples,
          box.mean,
          box.quartiles.minimum,
          box.quartiles.lower_quartile,
          box.quartiles.median,
          box.quartiles.upper_quartile,
          box.quartiles.maximum};
}

Table correlation_boxes(const SuiteAnalysis& analysis) {
  Table table{"correlation_boxes",
              "The correlations of each factor's matrix in one line",
              {"factor", "levels", "cells", "samples", "mean", "minimum", "lower_quartile",
               "median", "upper_quartile", "maximum", "held"}};
  for (const Box& box : analysis.boxes) {
    std::vector<Json> cells = box_cells(box);
    cells.insert(cells.begin(), box.factor);
    cells.emplace_back(held_of(analysis, box.factor));
    add(table, std::move(cells));
  }
  return table;
}

Table means(const SuiteAnalysis& analysis) {
  Table table{"mean_times",
              "Mean times by two factors, over comparable configurations",
              {"rows", "columns", "row", "column", "samples", "mean_ms", "held"}};
  for (const MeanTimes& each : analysis.mean_times) {
    const std::string held = text_of(each.scope.held);
    for (const MeanCell& cell : each.cells) {
      add(table,
          {each.rows, each.columns, cell.row, cell.column, cell.samples, cell.mean_ms, held});
    }
  }
  return table;
}

Table lines(const SuiteAnalysis& analysis) {
  Table table{"speed_ups",
              "Speed-ups by a line through pairs of times, t(reference) = intercept + speed_up·t; "
              "error = (1 − r)·speed_up",
              {"factor", "level", "reference", "pairs", "speed_up", "error", "low", "high", "r",
               "intercept_ms", "mean_ratio", "held"}};
  for (const SpeedUp& each : analysis.speed_ups) {
    add(table, {each.factor, each.level, each.reference, each.pairs, each.speed_up, each.error,
                each.speed_up - each.error, each.speed_up + each.error, each.r, each.intercept_ms,
                each.mean_ratio, text_of(each.scope.held)});
  }
  return table;
}

Table predictions(const SuiteAnalysis& analysis) {
  Table table{"predictions",
              "R² on the held-out part: linear regression per structure, random forest over all",
              {"data", "models", "held_out", "line_r2", "forest_r2", "trained", "structures",
               "structures_left_out", "line_features", "structure", "held"}};
  if (!analysis.prediction) return table;
  const Prediction& p = *analysis.prediction;
  const auto row = [&](const std::string& data, Json models, Json held_out, Json line,
                       Json forest) {
    add(table, {data, std::move(models), std::move(held_out), std::move(line), std::move(forest),
                p.trained, p.structures, p.structures_left_out, joined(p.line_features),
                joined(p.structure), text_of(p.scope.held)});
  };
  for (const Score& each : p.scores) {
    row(each.data, each.models, each.held_out, optional(each.line_r2), optional(each.forest_r2));
  }
  const Json none;
  row("mean of data sets", none, none, optional(p.line_mean), none);
  row("least of data sets", none, none, optional(p.line_least), none);
  row("largest of data sets", none, none, optional(p.line_largest), none);
  row("every held-out observation", none, p.held_out, none, optional(p.forest_on_all));
  return table;
}

Table camera_paths(const SuiteAnalysis& analysis) {
  Table table{
      "camera_paths",
      "Two-sample Kolmogorov-Smirnov tests of each path against all views, and of random "
      "subsets of the same size",
      {"path", "views", "samples", "all_views", "all_samples", "d", "p", "subsets_of", "subsets",
       "rejected", "d_mean", "p_minimum", "p_mean", "p_median", "p_maximum", "held"}};
  for (const PathTest& each : analysis.path_tests) {
    for (const bool views : {false, true}) {
      const SubsetTests& of = views ? each.of_views : each.of_samples;
      add(table,
          {each.path, each.views, each.samples, each.all_views, each.all_samples, each.test.d,
           each.test.p, views ? "views" : "samples", of.subsets, of.rejected, of.d_mean,
           of.p_minimum, of.p_mean, of.p_median, of.p_maximum, text_of(each.scope.held)});
    }
  }
  return table;
}

Table stack_boxes(const SuiteAnalysis& analysis) {
  Table table{"stacks",
              "Correlations along stacks of one data set in several sizes",
              {"name", "levels", "cells", "samples", "mean", "minimum", "lower_quartile", "median",
               "upper_quartile", "maximum", "held"}};
  for (const Stack& each : analysis.stacks) {
    std::vector<Json> cells = box_cells(each.box);
    cells.insert(cells.begin(), each.name);
    cells.emplace_back(text_of(each.matrix.scope.held));
    add(table, std::move(cells));
  }
  return table;
}

Table duplicates(const SuiteAnalysis& analysis) {
  Table table{"duplicates",
              "Configurations measured more than once on a device: the latest was taken",
              {"device", "configuration", "taken", "dropped"}};
  for (const Duplicate& each : analysis.dataset.duplicates) {
    add(table, {each.device, each.configuration, each.taken, each.dropped});
  }
  return table;
}

Table left_out(const SuiteAnalysis& analysis) {
  Table table{"left_out", "What could not be computed, and why", {"analysis", "reason"}};
  for (const LeftOut& each : analysis.left_out) add(table, {each.analysis, each.reason});
  return table;
}

std::string csv_field(const Json& cell) {
  if (cell.is_null()) return {};
  std::string text = cell.is_string() ? cell.get<std::string>() : cell.dump();
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace

std::vector<Table> tables(const SuiteAnalysis& analysis) {
  std::vector<Table> all;
  for (const auto make :
       {distribution_fits, percentiles, histograms, correlation_boxes, correlation_cells, means,
        lines, predictions, camera_paths, stack_boxes, left_out, duplicates, observations}) {
    Table table = make(analysis);
    if (!table.rows.empty()) all.push_back(std::move(table));
  }
  return all;
}

Json rows_of(const std::vector<Table>& tables, std::string_view name) {
  const auto found = std::ranges::find(tables, name, &Table::name);
  return found == tables.end() ? Json::array() : found->rows;
}

std::string csv(const Table& table) {
  std::string text;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    text += (i > 0 ? "," : "") + csv_field(table.columns[i]);
  }
  text += '\n';
  for (const Json& row : table.rows) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      text += (i > 0 ? "," : "") + csv_field(row.at(table.columns[i]));
    }
    text += '\n';
  }
  return text;
}

Json to_json(const std::vector<SuiteAnalysis>& analyses) {
  Json suites = Json::array();
  for (const SuiteAnalysis& each : analyses) {
    Json by_name = Json::object();
    for (const Table& table : tables(each)) by_name[table.name] = table.rows;
    suites.push_back({{"suite", each.dataset.suite},
                      {"clock", each.dataset.clock},
                      {"observations", each.dataset.observations.size()},
                      {"notes", each.dataset.notes},
                      {"tables", std::move(by_name)}});
  }
  return {{"schema", 1}, {"suites", std::move(suites)}};
}

}  // namespace triptych::analysis
