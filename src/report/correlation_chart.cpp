#include "report/correlation_chart.hpp"

#include <algorithm>
#include <cmath>

#include "core/json.hpp"
#include "core/json_text.hpp"

namespace triptych::report {
namespace {

using core::Json;

Json points(const judge::CorrelationPair& pair) {
  Json values = Json::array();
  for (const judge::CorrelationPoint& point : pair.points) {
    values.push_back({{"a", std::exp(point.x)},
                      {"b", std::exp(point.y)},
                      {"configuration", point.configuration},
                      {"kind", point.outlier ? "off" : "as expected"}});
  }
  return values;
}

// From the least to the most on A: straight on two logarithmic axes.
Json line_points(const judge::CorrelationPair& pair) {
  const auto [first, last] = std::ranges::minmax(pair.points, {}, &judge::CorrelationPoint::x);
  Json values = Json::array();
  for (const double x : {first.x, last.x}) {
    values.push_back({{"a", std::exp(x)}, {"b", std::exp(pair.line.at(x))}});
  }
  return values;
}

Json axis(const char* field, const std::string& title) {
  return {{"field", field},
          {"type", "quantitative"},
          {"title", title},
          {"scale", {{"type", "log"}, {"nice", false}, {"padding", 12}}}};
}

}  // namespace

std::string correlation_chart(const judge::CorrelationPair& pair) {
  const char* unit = pair.signal == "time" ? ", ns" : ", instructions";
  Json position{{"x", axis("a", pair.device_a + unit)}, {"y", axis("b", pair.device_b + unit)}};
  Json layers = Json::array();
  if (!pair.points.empty() && std::isfinite(pair.line.slope)) {
    layers.push_back({{"data", {{"values", line_points(pair)}}},
                      {"mark", {{"type", "line"}, {"color", "#555"}, {"strokeWidth", 1}}},
                      {"encoding", position}});
  }
  position["color"] = {{"field", "kind"}, {"type", "nominal"}, {"title", nullptr}};
  position["tooltip"] = Json::array({{{"field", "configuration"}}});
  layers.push_back(
      {{"mark", {{"type", "point"}, {"filled", true}}}, {"encoding", std::move(position)}});
  return core::json_text({{"$schema", "https://vega.github.io/schema/vega-lite/v5.json"},
                          {"data", {{"values", points(pair)}}},
                          {"width", 400},
                          {"height", 380},
                          {"layer", layers}});
}

}  // namespace triptych::report
