#include "report/correlation_chart.hpp"

#include <algorithm>
#include <cmath>

#include "core/json.hpp"
#include "core/json_text.hpp"

namespace triptych::report {
namespace {

using core::Json;

double milliseconds(double log_ns) {
  return 1e-6 * std::exp(log_ns);
}

bool has_line(const judge::CorrelationPair& pair) {
  return !pair.cases.empty() && pair.result.line.slope != 0;
}

std::string kind_of(const judge::CorrelationCase& each,
                    const judge::ConfigurationJudgement& judgement) {
  if (each.anchor) return "anchor";
  if (judgement.standing) return "slower, as when accepted";
  if (judgement.slower) return "slower";
  return judgement.faster ? "faster" : "as expected";
}

Json points(const judge::CorrelationPair& pair) {
  Json values = Json::array();
  for (std::size_t i = 0; i < pair.cases.size(); ++i) {
    const judge::CorrelationCase& each = pair.cases[i];
    const judge::ConfigurationJudgement& judgement = pair.result.judgements[i];
    values.push_back({{"a", milliseconds(each.log_time_a)},
                      {"b", milliseconds(each.log_time_b)},
                      {"technique", each.factors.at("technique")},
                      {"configuration", each.configuration},
                      {"deviation", std::expm1(judgement.residual)},
                      {"kind", kind_of(each, judgement)}});
  }
  return values;
}

// Those that are slower or faster.
Json named_points(const judge::CorrelationPair& pair) {
  Json named = Json::array();
  for (const Json& point : points(pair)) {
    if (point.at("kind") == "slower" || point.at("kind") == "faster") named.push_back(point);
  }
  return named;
}

// From the smallest to the largest time on A: straight on two logarithmic axes.
Json line_points(const judge::CorrelationPair& pair, double intercept) {
  const auto [first, last] =
      std::ranges::minmax(pair.cases, {}, &judge::CorrelationCase::log_time_a);
  Json values = Json::array();
  for (const double a : {first.log_time_a, last.log_time_a}) {
    values.push_back(
        {{"a", milliseconds(a)}, {"b", milliseconds(intercept + pair.result.line.slope * a)}});
  }
  return values;
}

Json axis(const char* field, const std::string& title) {
  return {{"field", field},
          {"type", "quantitative"},
          {"title", title + ", ms"},
          {"scale", {{"type", "log"}, {"nice", false}, {"padding", 12}}}};
}

Json line_layer(const judge::CorrelationPair& pair, double intercept, const Json& position,
                bool dashed) {
  Json mark{{"type", "line"}, {"color", "#555"}, {"strokeWidth", 1}};
  if (dashed) mark["strokeDash"] = Json::array({5, 4});
  return {
      {"data", {{"values", line_points(pair, intercept)}}}, {"mark", mark}, {"encoding", position}};
}

Json axis_of_deviations(const judge::CorrelationPair& pair) {
  double largest = std::expm1(pair.result.smallest_effect);
  for (std::size_t i = 0; i < pair.cases.size(); ++i) {
    if (pair.cases[i].anchor) continue;
    largest = std::max(largest, std::abs(std::expm1(pair.result.judgements[i].residual)));
  }
  return {{"field", "deviation"},
          {"type", "quantitative"},
          {"title", "from the line"},
          {"axis", {{"format", "+.0%"}}},
          {"scale", {{"domain", {-1.1 * largest, 1.1 * largest}}, {"nice", false}}}};
}

// A level of the deviation across the panel.
Json rule_layer(double deviation, const Json& axis, bool dashed) {
  Json mark{{"type", "rule"}, {"color", "#555"}, {"strokeWidth", 1}};
  if (dashed) mark["strokeDash"] = Json::array({2, 3});
  return {{"data", {{"values", Json::array({{{"deviation", deviation}}})}}},
          {"mark", mark},
          {"encoding", {{"y", axis}}}};
}

Json point_layer(const Json& position) {
  Json encoding = position;
  encoding["color"] = {{"field", "technique"}, {"type", "nominal"}};
  encoding["shape"] = {
      {"field", "kind"},
      {"type", "nominal"},
      {"title", nullptr},
      {"scale",
       {{"domain", {"as expected", "anchor", "slower", "slower, as when accepted", "faster"}},
        {"range", {"circle", "triangle-up", "cross", "diamond", "square"}}}}};
  encoding["tooltip"] = Json::array({{{"field", "configuration"}},
                                     {{"field", "a"}, {"format", ".3f"}},
                                     {{"field", "b"}, {"format", ".3f"}},
                                     {{"field", "deviation"}, {"format", "+.1%"}}});
  return {{"mark",
           {{"type", "point"}, {"filled", true}, {"size", 55}, {"opacity", 0.75}, {"clip", true}}},
          {"encoding", encoding}};
}

// Of points that are there: a layer without any has no extent, of which Vega warns.
Json label_layer(const Json& named, const Json& position) {
  Json encoding = position;
  encoding["text"] = {{"field", "deviation"}, {"type", "quantitative"}, {"format", "+.0%"}};
  return {{"data", {{"values", named}}},
          {"mark", {{"type", "text"}, {"align", "left"}, {"dx", 7}, {"fontSize", 11}}},
          {"encoding", encoding}};
}

Json panel(const Json& layers) {
  return {{"width", 400}, {"height", 380}, {"layer", layers}};
}

// Times against times, with the lines.
Json times_panel(const judge::CorrelationPair& pair, const Json& across) {
  const Json position{{"x", across}, {"y", axis("b", pair.device)}};
  Json layers = Json::array();
  if (has_line(pair)) {
    layers.push_back(line_layer(pair, pair.result.line.intercept, position, false));
    if (std::isfinite(pair.result.anchor_intercept)) {
      layers.push_back(line_layer(pair, pair.result.anchor_intercept, position, true));
    }
  }
  layers.push_back(point_layer(position));
  return panel(layers);
}

// What is left beside the line, in percent; above the dotted rule one configuration alone shows.
Json deviations_panel(const judge::CorrelationPair& pair, const Json& across) {
  const Json upwards = axis_of_deviations(pair);
  const Json position{{"x", across}, {"y", upwards}};
  Json layers = Json::array({rule_layer(0, upwards, false),
                             rule_layer(std::expm1(pair.result.smallest_effect), upwards, true),
                             point_layer(position)});
  const Json named = named_points(pair);
  if (!named.empty()) layers.push_back(label_layer(named, position));
  return panel(layers);
}

}  // namespace

std::string correlation_chart(const judge::CorrelationPair& pair) {
  const Json across = axis("a", pair.of_itself ? "its stored runs" : pair.other);
  Json panels = Json::array({times_panel(pair, across)});
  if (has_line(pair)) panels.push_back(deviations_panel(pair, across));
  const Json spec{{"$schema", "https://vega.github.io/schema/vega-lite/v5.json"},
                  {"data", {{"values", points(pair)}}},
                  {"hconcat", panels},
                  {"config", {{"view", {{"stroke", "#ddd"}}}, {"legend", {{"labelLimit", 220}}}}}};
  return core::json_text(spec);
}

}  // namespace triptych::report
