#include "report/verdict_json.hpp"

#include <cmath>
#include <utility>

namespace triptych::report {
namespace {

using core::Json;

// JSON has neither infinities nor NaN.
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

}  // namespace

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
            {"refusal", line.refusal}}},
          {"points", std::move(points)}};
}

Json to_json(const judge::GateResult& result) {
  Json findings = Json::array();
  for (const judge::Finding& finding : result.findings) {
    findings.push_back({{"check", judge::name_of(finding.check)},
                        {"verdict", judge::name_of(finding.verdict)},
                        {"test", finding.test},
                        {"device", finding.device},
                        {"configuration", finding.configuration},
                        {"message", finding.message},
                        {"numbers", Json(finding.numbers)}});
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
          {"headline", result.headline()},
          {"findings", std::move(findings)},
          {"correlations", std::move(correlations)},
          {"accuracies", std::move(accuracies)}};
}

}  // namespace triptych::report
