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

}  // namespace

Json to_json(const CorrelationPair& pair) {
  Json points = Json::array();
  for (const CorrelationPoint& point : pair.points) {
    points.push_back({{"configuration", point.configuration},
                      {"x", number(point.x)},
                      {"y", number(point.y)},
                      {"residual", number(point.residual)},
                      {"outlier", point.outlier}});
  }
  const CorrelationLine& line = pair.line;
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

}  // namespace triptych::judge
