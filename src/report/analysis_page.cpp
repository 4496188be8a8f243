#include "report/analysis_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "analysis/tables.hpp"
#include "report/analysis_charts.hpp"
#include "report/html.hpp"
#include "report/page_frame.hpp"

namespace triptych::report {
namespace {

using analysis::SuiteAnalysis;
using analysis::Table;
using core::Json;

std::string cell_text(const Json& cell) {
  if (cell.is_null()) return "–";
  if (cell.is_string()) return escape(cell.get<std::string>());
  return cell.is_number_float() ? fmt::format("{:.4g}", cell.get<double>()) : cell.dump();
}

// What all rows hold fixed, which then need not each say so; nothing where they differ.
std::optional<std::string> held_by_all(const Table& table_of) {
  if (table_of.rows.empty() || !table_of.rows.front().contains("held")) return std::nullopt;
  const Json& held = table_of.rows.front().at("held");
  const bool same =
      std::ranges::all_of(table_of.rows, [&](const Json& row) { return row.at("held") == held; });
  if (!same || !held.is_string()) return std::nullopt;
  return held.get<std::string>();
}

std::string html_table(const Table& table_of) {
  const std::optional<std::string> held = held_by_all(table_of);
  std::vector<std::string> columns = table_of.columns;
  if (held) std::erase(columns, "held");
  std::vector<std::vector<std::string>> rows{{}};
  for (const std::string& column : columns) rows.front().push_back(escape(column));
  for (const Json& row : table_of.rows) {
    std::vector<std::string>& cells = rows.emplace_back();
    for (const std::string& column : columns) cells.push_back(cell_text(row.at(column)));
  }
  const std::string all =
      held ? "<p class=\"system\">held: " + (held->empty() ? "nothing" : escape(*held)) + "</p>"
           : "";
  return "<p>" + escape(table_of.title) + ".</p>" + all + table(rows);
}

// The sections of one suite.
class SuitePage {
 public:
  explicit SuitePage(const SuiteAnalysis& analysis)
      : analysis_(analysis), tables_(analysis::tables(analysis)) {}

  [[nodiscard]] std::string html() {
    text_ = fmt::format("<section><h2>{}</h2><p>{} configurations on their devices, {} time.</p>",
                        escape(analysis_.dataset.suite), analysis_.dataset.observations.size(),
                        analysis_.dataset.clock);
    for (const std::string& note : analysis_.dataset.notes) {
      text_ += "<p class=\"system\">" + escape(note) + ".</p>\n";
    }
    add_distributions();
    add_correlations();
    add_means();
    add_speed_ups();
    add_open("Prediction", "predictions");
    add_open("Camera paths against all views", "camera_paths");
    add_open("Stacks of sizes", "stacks");
    add_open("Left out", "left_out");
    add_folded("Measured more than once", "duplicates");
    return text_ + "</section>\n";
  }

 private:
  void add_figure(const std::string& title, const std::string& label, const std::string& svg) {
    if (svg.empty()) return;
    text_ += fmt::format("<div class=\"plot\"><h4>{}</h4><p class=\"system\">{}</p>{}</div>",
                         escape(title), escape(label), svg);
  }
  [[nodiscard]] const Table* table_named(std::string_view name) const {
    for (const Table& each : tables_) {
      if (each.name == name) return &each;
    }
    return nullptr;
  }
  void add_open(const std::string& heading, std::string_view name) {
    if (const Table* found = table_named(name)) {
      text_ += "<h3>" + heading + "</h3>" + html_table(*found);
    }
  }
  void add_folded(const std::string& summary, std::string_view name) {
    if (const Table* found = table_named(name)) {
      text_ += "<details><summary>" + summary + "</summary>" + html_table(*found) + "</details>\n";
    }
  }
  // Rows of a table whose columns have these values.
  [[nodiscard]] Json rows_where(
      std::string_view name, const std::vector<std::pair<std::string, std::string>>& wanted) const {
    Json chosen = Json::array();
    for (const Json& row : analysis::rows_of(tables_, name)) {
      bool fits = true;
      for (const auto& [column, value] : wanted) fits = fits && row.at(column) == value;
      if (fits) chosen.push_back(row);
    }
    return chosen;
  }
  static std::string label(std::size_t samples, const analysis::Scope& scope) {
    const std::string held = analysis::text_of(scope.held);
    return fmt::format("{} samples; held: {}", samples, held.empty() ? "nothing" : held);
  }

  void add_distributions() {
    if (analysis_.distributions.empty()) return;
    text_ += "<h3>Distribution of times</h3>\n";
    for (const auto& each : analysis_.distributions) {
      if (each.of != "all") continue;
      for (const bool logarithmic : {false, true}) {
        add_figure(
            fmt::format("{} time, {} scale, with a log-normal fit", each.clock,
                        logarithmic ? "logarithmic" : "linear"),
            label(each.scope.samples, each.scope),
            histogram_chart(rows_where("histograms", {{"of", each.of},
                                                      {"clock", each.clock},
                                                      {"scale", logarithmic ? "log10" : "linear"}}),
                            logarithmic));
      }
    }
    text_ += html_table(*table_named("distributions"));
    add_folded("Percentiles", "percentiles");
  }

  void add_correlations() {
    if (analysis_.matrices.empty()) return;
    text_ += "<h3>Correlation of the levels of each factor</h3>\n";
    add_figure("Pearson's r between all pairs of levels", "numbers of samples: table below",
               correlation_boxes_chart(analysis::rows_of(tables_, "correlations")));
    text_ += html_table(*table_named("correlation_boxes"));
    for (const auto& matrix : analysis_.matrices) {
      if (matrix.levels.size() < 3) continue;  // one number, which the table has
      add_figure(matrix.factor, label(matrix.scope.samples, matrix.scope),
                 correlation_matrix_chart(rows_where("correlations", {{"factor", matrix.factor}})));
    }
    add_folded("Every pair of levels", "correlations");
  }

  void add_means() {
    if (analysis_.mean_times.empty()) return;
    text_ += "<h3>Mean times</h3>\n";
    for (const auto& each : analysis_.mean_times) {
      add_figure(fmt::format("{} by {}, ms", each.rows, each.columns),
                 label(each.scope.samples, each.scope),
                 mean_times_chart(
                     rows_where("mean_times", {{"rows", each.rows}, {"columns", each.columns}})));
    }
  }

  void add_speed_ups() {
    if (analysis_.speed_ups.empty()) return;
    text_ += "<h3>Speed-ups</h3>\n";
    for (const auto& matrix : analysis_.matrices) {
      const Json rows = rows_where("speed_ups", {{"factor", matrix.factor}});
      if (rows.empty()) continue;
      add_figure(fmt::format("{}, relative to {}", matrix.factor,
                             rows.front().at("reference").get<std::string>()),
                 label(matrix.scope.samples, matrix.scope), speed_ups_chart(rows));
    }
    add_folded("The lines", "speed_ups");
  }

  const SuiteAnalysis& analysis_;
  std::vector<Table> tables_;
  std::string text_;
};

}  // namespace

std::string analysis_page(const std::vector<SuiteAnalysis>& analyses) {
  std::string text =
      page_begin("Triptych analysis") +
      "<header><h1>Triptych: analysis</h1><p>Distributions, correlations between the levels of "
      "every factor, speed-ups, predictions and what a camera path stands for, after Bruder, "
      "Müller, Frey and Ertl.</p></header>\n";
  for (const SuiteAnalysis& each : analyses) text += SuitePage(each).html();
  return text + page_end();
}

}  // namespace triptych::report
