#include "report/charts.hpp"

#include "core/json.hpp"
#include "core/json_text.hpp"

namespace triptych::report {
namespace {

using core::Json;

Json samples(const PlanData& plan) {
  Json values = Json::array();
  for (const record::Record& record : plan.records) {
    if (!record.same_as.empty()) continue;
    for (const double ns : record.time_ns()) {
      values.push_back({{"ms", ns / 1e6},
                        {"device", record.device},
                        {"technique", record.technique},
                        {"scene", scene_title(plan, record)}});
    }
  }
  return values;
}

}  // namespace

std::string time_chart(const PlanData& plan) {
  const Json y{{"field", "device"}, {"type", "nominal"}, {"title", nullptr}};
  const Json x{{"field", "ms"},
               {"type", "quantitative"},
               {"title", "time of a frame, ms"},
               {"scale", {{"type", "log"}}}};
  const Json colour{{"field", "technique"}, {"type", "nominal"}};
  const Json offset{{"field", "technique"}};
  const Json box{
      {"mark", {{"type", "boxplot"}, {"extent", "min-max"}, {"size", 8}, {"opacity", 0.5}}},
      {"encoding", {{"x", x}, {"y", y}, {"yOffset", offset}, {"color", colour}}}};
  const Json points{
      {"mark", {{"type", "tick"}, {"thickness", 1}, {"size", 10}}},
      {"encoding",
       {{"x", x},
        {"y", y},
        {"yOffset", offset},
        {"color", colour},
        {"tooltip",
         Json::array({{{"field", "device"}}, {{"field", "technique"}}, {{"field", "ms"}}})}}}};
  const Json spec{{"$schema", "https://vega.github.io/schema/vega-lite/v5.json"},
                  {"data", {{"values", samples(plan)}}},
                  {"facet",
                   {{"field", "scene"},
                    {"type", "nominal"},
                    {"title", nullptr},
                    {"header", {{"labelLimit", 420}, {"labelFontSize", 11}}}}},
                  {"columns", 2},
                  {"resolve", {{"axis", {{"x", "independent"}}}}},
                  {"spec", {{"width", 380}, {"layer", Json::array({box, points})}}},
                  {"config", {{"view", {{"stroke", "#ddd"}}}, {"axis", {{"labelLimit", 200}}}}}};
  return core::json_text(spec);
}

}  // namespace triptych::report
