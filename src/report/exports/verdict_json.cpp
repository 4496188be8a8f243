#include "report/exports/verdict_json.hpp"

#include <cmath>
#include <utility>

#include "report/words/finding.hpp"

namespace triptych::report {
namespace {

using core::Json;

// Infinities and NaN become null, because JSON cannot represent them.
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

}  // namespace

Json changes_json(const std::vector<judge::Change>& all) {
  Json changes = Json::array();
  for (const judge::Change& each : all) {
    Json change{{"name", each.name}, {"unit", judge::name_of(each.unit)}};
    if (each.before) change["before"] = number(*each.before);
    if (each.now) change["now"] = number(*each.now);
    if (!each.accepted.empty()) change["accepted"] = each.accepted;
    if (each.allowed > 0) change["allowed"] = number(each.allowed);
    changes.push_back(std::move(change));
  }
  return changes;
}

Json observation_json(const judge::Observation& what) {
  Json json{{"cause", judge::name_of(what.cause)}, {"numbers", what.numbers}};
  if (what.against != judge::Against::nothing) json["against"] = judge::name_of(what.against);
  if (!what.changes.empty()) json["changes"] = changes_json(what.changes);
  if (!what.names.empty()) json["names"] = what.names;
  if (!what.facts.empty()) json["facts"] = what.facts;
  if (!what.detail.empty()) json["detail"] = what.detail;
  if (what.reason.cause != record::Cause::none) {
    json["outcome"] = record::name_of(what.outcome);
    json["reason"] = what.reason;
  }
  for (const judge::Observation& each : what.because)
    json["because"].push_back(observation_json(each));
  return json;
}

Json to_json(const judge::CorrelationPair& pair) {
  Json points = Json::array();
  for (const judge::CorrelationPoint& point : pair.points) {
    points.push_back({{"configuration", point.configuration},
                      {"x", number(point.x)},
                      {"y", number(point.y)},
                      {"residual", number(point.residual)},
                      {"outlier", point.outlier}});
  }
  const judge::CorrelationLine& line = pair.line;
  return {{"device_a", pair.device_a},
          {"device_b", pair.device_b},
          {"signal", pair.signal},
          {"new_device", pair.new_device},
          {"line",
           {{"configurations", line.configurations},
            {"intercept", number(line.intercept)},
            {"slope", number(line.slope)},
            {"scale", number(line.scale)},
            {"rho", number(line.rho)},
            {"pearson", number(line.pearson)},
            {"admitted", line.admitted()},
            {"refusal", judge::name_of(line.refusal)}}},
          {"points", std::move(points)}};
}

Json to_json(const judge::Finding& finding) {
  Json json = observation_json(finding);
  json["check"] = judge::name_of(finding.check);
  json["verdict"] = judge::name_of(finding.verdict);
  json["test"] = finding.test;
  json["device"] = finding.device;
  json["configuration"] = finding.configuration;
  json["message"] = words::text_of(finding);
  if (!finding.subject.empty()) json["subject"] = finding.subject;
  if (!finding.injected.empty()) json["injected"] = finding.injected;
  if (finding.measured_before) json["measured_before"] = true;
  if (finding.advice.advice != judge::Advice::none) {
    json["advice"] = {{"kind", judge::name_of(finding.advice.advice)},
                      {"command", finding.advice.command}};
  }
  if (finding.excuse.kind != judge::Excuse::Kind::nothing) {
    json["excuse"] = {{"kind", judge::name_of(finding.excuse.kind)},
                      {"known", judge::name_of(finding.excuse.outcome)},
                      {"reason", finding.excuse.reason},
                      {"expiry", finding.excuse.expiry}};
  }
  if (finding.retry_result != judge::RetryResult::not_drawn) {
    json["drawn_again"] = judge::name_of(finding.retry_result);
  }
  for (const judge::Observation& each : finding.retry_observations) {
    json["again"] = observation_json(each);
  }
  return json;
}

Json to_json(const judge::GateResult& result) {
  Json findings = Json::array();
  for (const judge::Finding& finding : result.findings) {
    findings.push_back(to_json(finding));
  }
  Json correlations = Json::array();
  for (const judge::CorrelationPair& pair : result.correlations)
    correlations.push_back(to_json(pair));
  Json accuracies = Json::array();
  for (const accuracy::AccuracyScene& scene : result.accuracies)
    accuracies.push_back(to_json(scene));
  return {{"plan", result.plan},
          {"run", result.run},
          {"exit_code", static_cast<int>(result.exit_code())},
          {"headline", words::headline(result)},
          {"findings", std::move(findings)},
          {"correlations", std::move(correlations)},
          {"accuracies", std::move(accuracies)}};
}

}  // namespace triptych::report
