#include <cmath>

#include "core/json.hpp"
#include "judge/gate/gate.hpp"

namespace triptych::judge {
namespace {

using core::Json;

// JSON has neither infinities nor NaN.
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json configuration(const CorrelationCase& each, const ConfigurationJudgement& judgement) {
  Json json{{"configuration", each.configuration},
            {"technique", each.factors.at("technique")},
            {"anchor", each.anchor},
            {"time_a_ns", number(std::exp(each.log_time_a))},
            {"time_b_ns", number(std::exp(each.log_time_b))},
            {"residual", number(judgement.residual)},
            {"leverage", number(judgement.leverage)},
            {"z", number(judgement.z)},
            {"p", number(judgement.p)},
            {"q", number(judgement.q)},
            {"slower", judgement.slower},
            {"faster", judgement.faster},
            {"standing", judgement.standing},
            {"share", number(judgement.share)}};
  if (each.work) {
    json["work_unit"] = each.work->unit;
    json["log_work"] = number(each.work->log_ratio);
    json["log_time_per_work"] = number(judgement.residual - each.work->log_ratio);
  }
  return json;
}

Json level_json(const LevelEffect& level) {
  return {{"factor", level.factor},
          {"level", level.level},
          {"aliases", level.aliases},
          {"configurations", level.size},
          {"effect", number(level.effect)},
          {"standard_error", number(level.standard_error)},
          {"p", number(level.p)},
          {"q", number(level.q)},
          {"smallest_effect", number(level.smallest_effect)},
          {"share", number(level.share)},
          {"slower", level.slower},
          {"standing", level.standing}};
}

Json global_json(const GlobalShift& global) {
  return {{"since_acceptance", global.since_acceptance},
          {"groups", global.groups},
          {"delta", number(global.delta)},
          {"standard_error", number(global.standard_error)},
          {"degrees", number(global.degrees)},
          {"p", number(global.p)},
          {"smallest_effect", number(global.smallest_effect)},
          {"slower", global.slower}};
}

}  // namespace

Json to_json(const CorrelationPair& pair) {
  const Correlation& result = pair.result;
  Json configurations = Json::array();
  for (std::size_t i = 0; i < pair.cases.size(); ++i) {
    configurations.push_back(configuration(pair.cases[i], result.judgements[i]));
  }
  Json levels = Json::array();
  for (const LevelEffect& level : result.levels) levels.push_back(level_json(level));
  return {{"device", pair.device},
          {"other", pair.other},
          {"other_key", pair.other_key},
          {"within_run", pair.within_run},
          {"of_itself", pair.of_itself},
          {"decides", pair.decides},
          {"unlike_clocks", pair.unlike_clocks},
          {"unlike_anchors", pair.unlike_anchors},
          {"stored_runs", pair.stored_runs},
          {"refusals", result.refusals},
          {"r", number(result.r)},
          {"rho", number(result.rho)},
          {"intercept", number(result.line.intercept)},
          {"intercept_error", number(result.intercept_error)},
          {"slope", number(result.line.slope)},
          {"slope_error", number(result.slope_error)},
          {"scale", number(result.scale)},
          {"anchor_intercept", number(result.anchor_intercept)},
          {"line_of_acceptance", result.line_of_acceptance},
          {"line_beside", result.line_beside},
          {"smallest_effect", number(result.smallest_effect)},
          {"configurations", std::move(configurations)},
          {"levels", std::move(levels)},
          {"global", global_json(result.global)}};
}

}  // namespace triptych::judge
