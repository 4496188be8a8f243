#include "report/accuracy_chart.hpp"

#include <algorithm>
#include <optional>
#include <sstream>
#include <vector>

#include "core/json.hpp"
#include "core/json_text.hpp"

namespace triptych::report {
namespace {

using core::Json;

std::optional<double> cost_of(const judge::AccuracyCase& each, Cost cost) {
  if (cost == Cost::time && each.time_ns) return *each.time_ns / 1e6;
  if (cost == Cost::time || !each.samples) return std::nullopt;
  return static_cast<double>(*each.samples);
}

// What the colour tells: of configurations that stand alone the technique, else there would be as
// many colours as points.
std::string colour_of(const judge::AccuracyFamily& family, const judge::AccuracyCase& each) {
  const auto technique = each.factors.find("technique");
  const bool alone = family.members.size() == 1 && technique != each.factors.end();
  return alone ? technique->second : family.name;
}

std::vector<std::string> factors_of(const judge::AccuracyScene& scene) {
  std::vector<std::string> factors;
  std::istringstream text(scene.scene);
  for (std::string factor; std::getline(text, factor, ',');) factors.push_back(factor);
  return factors;
}

void append_scene(Json& values, const std::string& title, const judge::AccuracyScene& scene,
                  Cost cost) {
  for (const judge::AccuracyFamily& family : scene.families) {
    for (const std::size_t i : family.members) {
      const judge::AccuracyCase& each = scene.cases[i];
      const auto paid = cost_of(each, cost);
      if (!paid || !(*paid > 0) || !(each.rmse > 0)) continue;
      const auto step = each.factors.find("step");
      values.push_back({{"data", title},
                        {"device", scene.device},
                        {"family", family.name},
                        {"colour", colour_of(family, each)},
                        {"step", step == each.factors.end() ? "" : step->second},
                        {"error", each.rmse},
                        {"cost", *paid},
                        {"front", std::ranges::find(scene.front, i) != scene.front.end()},
                        {"configuration", each.configuration}});
    }
  }
}

Json axis(const char* field, const char* title, const char* format) {
  return {{"field", field},
          {"type", "quantitative"},
          {"title", title},
          {"scale", {{"type", "log"}, {"nice", false}, {"padding", 6}}},
          {"axis", {{"format", format}, {"tickCount", 5}, {"labelFlush", false}}}};
}

Json facet(const char* field) {
  return {
      {"field", field},
      {"type", "nominal"},
      {"title", nullptr},
      {"sort", nullptr},
      // A line for the data, one for each factor: together they are longer than a row is high.
      {"header",
       {{"labelLimit", 200}, {"labelFontSize", 11}, {"labelExpr", "split(datum.label, ', ')"}}}};
}

// The cases are in the order of their steps already.
Json line_layer(const Json& position) {
  Json encoding = position;
  encoding["color"] = {{"field", "colour"}, {"type", "nominal"}, {"title", nullptr}};
  encoding["detail"] = {{"field", "family"}, {"type", "nominal"}};
  encoding["order"] = {{"field", "error"}, {"type", "quantitative"}};
  encoding["tooltip"] = Json::array({{{"field", "configuration"}},
                                     {{"field", "error"}, {"format", ".3g"}},
                                     {{"field", "cost"}, {"format", ".3g"}}});
  return {{"mark", {{"type", "line"}, {"strokeWidth", 1}, {"point", {{"size", 14}}}}},
          {"encoding", encoding}};
}

Json front_layer(const Json& position) {
  Json encoding = position;
  encoding["order"] = {{"field", "error"}, {"type", "quantitative"}};
  return {{"transform", Json::array({{{"filter", "datum.front"}}})},
          {"mark",
           {{"type", "line"},
            {"color", "black"},
            {"strokeWidth", 1.5},
            {"interpolate", "linear"},
            {"point", {{"size", 40}, {"filled", false}, {"color", "black"}}}}},
          {"encoding", encoding}};
}

Json goal_layer() {
  Json goals = Json::array();
  for (const double goal : judge::accuracy_goals) goals.push_back({{"error", goal}});
  return {{"data", {{"values", goals}}},
          {"mark", {{"type", "rule"}, {"color", "#bbb"}, {"strokeDash", Json::array({3, 3})}}},
          {"encoding", {{"x", {{"field", "error"}, {"type", "quantitative"}}}}}};
}

}  // namespace

std::string accuracy_title(std::span<const judge::AccuracyScene> scenes,
                           const judge::AccuracyScene& scene) {
  std::string title = scene.data;
  for (const std::string& factor : factors_of(scene)) {
    const auto lacks = [&](const judge::AccuracyScene& other) {
      const std::vector<std::string> theirs = factors_of(other);
      return other.data == scene.data && std::ranges::find(theirs, factor) == theirs.end();
    };
    if (std::ranges::any_of(scenes, lacks)) title += ", " + factor;
  }
  return title;
}

std::string accuracy_chart(std::span<const judge::AccuracyScene> scenes, Cost cost) {
  Json values = Json::array();
  for (const judge::AccuracyScene& scene : scenes) {
    append_scene(values, accuracy_title(scenes, scene), scene, cost);
  }
  const Json position{{"x", axis("error", "RMSE against the limit", ".0e")},
                      {"y", cost == Cost::time ? axis("cost", "time of a frame, ms", "~g")
                                               : axis("cost", "samples taken", ".0e")}};
  const Json spec{
      {"$schema", "https://vega.github.io/schema/vega-lite/v5.json"},
      {"data", {{"values", values}}},
      {"facet", {{"row", facet("data")}, {"column", facet("device")}}},
      {"spec",
       {{"width", 210},
        {"height", 150},
        {"layer", Json::array({goal_layer(), line_layer(position), front_layer(position)})}}},
      {"config",
       {{"view", {{"stroke", "#ddd"}}},
        {"legend", {{"labelLimit", 320}, {"orient", "top"}, {"columns", 4}}}}}};
  return core::json_text(spec);
}

}  // namespace triptych::report
