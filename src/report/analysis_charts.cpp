#include "report/analysis_charts.hpp"

#include "core/json_text.hpp"

namespace triptych::report {
namespace {

using core::Json;

Json field(const char* name, const char* type, Json title) {
  return {{"field", name}, {"type", type}, {"title", std::move(title)}};
}

// Levels in the order of the rows, which is their natural one.
Json level_field(const char* name, Json title) {
  Json result = field(name, "nominal", std::move(title));
  result["sort"] = nullptr;
  return result;
}

Json specification(const Json& rows) {
  return {{"$schema", "https://vega.github.io/schema/vega-lite/v5.json"},
          {"data", {{"values", rows}}},
          {"config", {{"view", {{"stroke", "#ddd"}}}, {"axis", {{"labelLimit", 260}}}}}};
}

Json tooltip(std::initializer_list<const char*> fields) {
  Json result = Json::array();
  for (const char* each : fields) result.push_back({{"field", each}});
  return result;
}

// Coloured cells with their number in them.
std::string heat_map(const Json& rows, const Json& x, const Json& y, Json value, const char* format,
                     const Json& details) {
  Json spec = specification(rows);
  spec["width"] = {{"step", 54}};
  spec["height"] = {{"step", 24}};
  Json number = value;
  number["format"] = format;
  number.erase("scale");
  value["legend"] = {{"format", format}};
  // Light enough for a black number on either end of the scale.
  const Json cell{{"mark", {{"type", "rect"}, {"opacity", 0.7}}},
                  {"encoding", {{"color", value}, {"tooltip", details}}}};
  const Json text{{"mark", {{"type", "text"}, {"fontSize", 10}}}, {"encoding", {{"text", number}}}};
  spec["encoding"] = {{"x", x}, {"y", y}};
  spec["layer"] = Json::array({cell, text});
  return core::json_text(spec);
}

}  // namespace

std::string histogram_chart(const Json& bins, bool logarithmic) {
  Json spec = specification(bins);
  spec["width"] = 460;
  spec["height"] = 220;
  Json x = field("from_ms", "quantitative", "time of a frame, ms");
  if (logarithmic) x["scale"] = {{"type", "log"}};
  // The fit belongs to the middle of a bin, on the bins' own scale.
  spec["transform"] =
      Json::array({{{"calculate", logarithmic ? "sqrt(datum.from_ms * datum.to_ms)"
                                              : "(datum.from_ms + datum.to_ms) / 2"},
                    {"as", "middle"}}});
  Json middle = field("middle", "quantitative", x.at("title"));
  if (logarithmic) middle["scale"] = {{"type", "log"}};
  const Json bars{{"mark", {{"type", "bar"}, {"binSpacing", 1}}},
                  {"encoding",
                   {{"x", x},
                    {"x2", {{"field", "to_ms"}}},
                    {"y", field("count", "quantitative", "configurations")},
                    {"y2", {{"datum", 0}}},
                    {"tooltip", tooltip({"from_ms", "to_ms", "count", "expected"})}}}};
  const Json curve{
      {"mark", {{"type", "line"}, {"color", "#222"}, {"interpolate", "monotone"}}},
      {"encoding", {{"x", middle}, {"y", field("expected", "quantitative", "configurations")}}}};
  spec["layer"] = Json::array({bars, curve});
  return core::json_text(spec);
}

std::string correlation_boxes_chart(const Json& cells) {
  Json known = Json::array();
  for (const Json& each : cells) {
    if (!each.at("r").is_null()) known.push_back(each);
  }
  Json spec = specification(known);
  spec["width"] = 560;
  spec["height"] = {{"step", 26}};
  Json x = field("r", "quantitative", "Pearson's r");
  x["scale"] = {{"zero", false}};
  // A factor of two levels has one r, of which a box shows nothing.
  const Json box{{"mark", {{"type", "boxplot"}, {"extent", "min-max"}, {"size", 14}}}};
  const Json ticks{{"mark", {{"type", "tick"}, {"color", "#222"}, {"thickness", 1}}},
                   {"encoding", {{"tooltip", tooltip({"factor", "a", "b", "r", "pairs"})}}}};
  spec["encoding"] = {{"x", x}, {"y", field("factor", "nominal", nullptr)}};
  spec["layer"] = Json::array({box, ticks});
  return core::json_text(spec);
}

std::string correlation_matrix_chart(const Json& cells) {
  // Every level in its natural order: the first one and all that it is paired with.
  Json order = Json::array();
  Json both = Json::array();
  for (const Json& each : cells) {
    if (order.empty()) order.push_back(each.at("a"));
    if (each.at("a") == order.front()) order.push_back(each.at("b"));
    both.push_back(each);
    both.push_back(each);
    both.back()["a"] = each.at("b");
    both.back()["b"] = each.at("a");
  }
  Json r = field("r", "quantitative", "r");
  r["scale"] = {{"scheme", "redyellowgreen"}, {"domain", {0, 1}}, {"clamp", true}};
  Json x = level_field("a", nullptr);
  Json y = level_field("b", nullptr);
  x["sort"] = order;
  y["sort"] = order;
  return heat_map(both, x, y, r, ".2f", tooltip({"a", "b", "r", "pairs"}));
}

std::string mean_times_chart(const Json& cells) {
  Json ms = field("mean_ms", "quantitative", "mean, ms");
  ms["scale"] = {{"scheme", "yelloworangered"}, {"type", "log"}};
  return heat_map(cells, level_field("column", nullptr), level_field("row", nullptr), ms, ".3~g",
                  tooltip({"row", "column", "mean_ms", "samples"}));
}

std::string speed_ups_chart(const Json& rows) {
  Json spec = specification(rows);
  spec["width"] = 460;
  spec["height"] = {{"step", 24}};
  const Json y = level_field("level", nullptr);
  const Json bar{{"mark", {{"type", "bar"}, {"opacity", 0.75}}},
                 {"encoding",
                  {{"x", field("speed_up", "quantitative", "speed-up")},
                   {"y", y},
                   {"tooltip", tooltip({"level", "reference", "speed_up", "error", "r", "pairs",
                                        "mean_ratio"})}}}};
  const Json error{
      {"mark", {{"type", "rule"}, {"strokeWidth", 2}}},
      {"encoding",
       {{"x", field("low", "quantitative", "speed-up")}, {"x2", {{"field", "high"}}}, {"y", y}}}};
  spec["layer"] = Json::array({bar, error});
  return core::json_text(spec);
}

}  // namespace triptych::report
