#include "report/page/charts.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "report/figures/figure.hpp"
#include "report/html.hpp"

namespace triptych::report {
namespace {

struct Row {
  std::string device;
  std::string technique;
  std::vector<double> ms;
};

struct ChartScene {
  std::string title;
  std::vector<Row> rows;
};

// Returns the scenes in the order of their first configuration. Configurations that have the same
// title, device and technique share a row.
std::vector<ChartScene> scenes_of(const PlanData& plan) {
  std::vector<ChartScene> scenes;
  for (const record::Record& record : plan.records) {
    if (!record.same_as.empty() || record.time_ns().empty()) continue;
    const std::string title = scene_title(plan, record);
    auto scene = std::ranges::find(scenes, title, &ChartScene::title);
    if (scene == scenes.end()) scene = scenes.insert(scenes.end(), {title, {}});
    auto row = std::ranges::find_if(scene->rows, [&](const Row& each) {
      return each.device == record.device && each.technique == record.technique;
    });
    if (row == scene->rows.end()) {
      row = scene->rows.insert(scene->rows.end(), {record.device, record.technique, {}});
    }
    for (const double ns : record.time_ns()) row->ms.push_back(ns / 1e6);
  }
  return scenes;
}

Html figure_of(const ChartScene& scene, const std::vector<std::string>& techniques) {
  Axis up;
  for (const Row& row : scene.rows) up.names.push_back(row.device + " " + row.technique);
  Figure figure("Frame times: " + scene.title, {.title = "frame time, ms", .logarithmic = true}, up,
                180, 18 * static_cast<double>(scene.rows.size()));
  for (std::size_t i = 0; i < scene.rows.size(); ++i) {
    const Row& row = scene.rows[i];
    const auto place = static_cast<double>(i);
    const auto technique = std::ranges::find(techniques, row.technique) - techniques.begin();
    const std::string_view colour = colour_of(static_cast<std::size_t>(technique));
    const record::Summary summary = *record::summarise(row.ms);
    figure.box({summary.lower_quartile, place - 0.32}, {summary.upper_quartile, place + 0.32},
               {.colour = colour, .opacity = 0.35},
               row.device + " " + row.technique + ": median " + duration(1e6 * summary.median));
    figure.series(row.device + " " + row.technique);
    figure.strokes(row.ms, place, 0.25, {.colour = colour, .opacity = 0.7, .width = 1});
    figure.series({});
    figure.strokes(std::vector{summary.median}, place, 0.4, {.colour = "ink", .width = 2});
  }
  return figure.svg();
}

}  // namespace

Html time_chart(const PlanData& plan) {
  const std::vector<ChartScene> scenes = scenes_of(plan);
  std::set<std::string> names;
  for (const ChartScene& scene : scenes) {
    for (const Row& row : scene.rows) names.insert(row.technique);
  }
  const std::vector<std::string> techniques(names.begin(), names.end());
  std::vector<TitledFigure> all;
  for (const ChartScene& scene : scenes) all.push_back({scene.title, figure_of(scene, techniques)});
  return all.empty() ? Html() : figures(all);
}

}  // namespace triptych::report
