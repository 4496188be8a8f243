#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "measure/contract/suite.hpp"

namespace triptych::measure {

// A suite that draws nothing. Tests derive from it and define its images.
class StubSuite : public SuiteWithTruth {
 public:
  explicit StubSuite(std::vector<Factor> factors = {}) : factors_(std::move(factors)) {}

  const std::vector<Factor>& factors() const override { return factors_; }
  void check(const Factor&, std::string_view) const override {}
  std::vector<std::string_view> plan_names() const override { return {}; }
  std::string_view plan_text(std::string_view) const override { return {}; }
  std::string missing_data(const Configuration&) const override { return {}; }
  Work work(Configuration&, const Device&) override { return {}; }
  Work calibration(technique::Work) override { return {}; }
  nlohmann::json describe(const Configuration&) override { return {}; }

 private:
  std::vector<Factor> factors_;
};

}  // namespace triptych::measure
