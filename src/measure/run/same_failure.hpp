#pragma once
// A driver fault that ends the worker usually affects many configurations, and each of them takes a
// new worker or the whole time limit. Therefore, if two configurations have failed in the same way,
// similar configurations are not tried.

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "measure/contract/suite.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// The failures of one device in one plan.
class SameFailure {
 public:
  // `varied`: the factors that have more than one value in the plan; the reason names their levels.
  explicit SameFailure(std::vector<std::string> varied) : varied_(std::move(varied)) {}

  void saw(const Configuration& configuration, const record::Record& record);

  struct Foretold {
    record::Outcome outcome;
    // The reason of the configurations that were tried, with the levels that they share. It is
    // marked as not tried.
    record::Reason reason;
  };
  // Returns the predicted outcome of the configuration, or nullopt if it has to be tried. A factor
  // is irrelevant if two configurations that differ in this factor failed in the same way. A
  // configuration is predicted to fail like an earlier configuration that crashed, hung or lost the
  // device if two conditions are met: both differ only in irrelevant factors, and no configuration
  // that differs from the earlier one only in irrelevant factors was measured successfully.
  [[nodiscard]] std::optional<Foretold> foretold(const Configuration& configuration) const;

 private:
  using Factors = std::set<std::string>;
  struct Failure {
    Configuration configuration;
    record::Outcome outcome;
    record::Reason reason;
    std::string kind;  // kind of outcome and reason
  };
  [[nodiscard]] bool is_refuted(const Configuration& configuration, const Factors& but_for) const;

  std::vector<std::string> varied_;
  std::vector<Configuration> measured_;
  std::vector<Failure> failures_;
  std::map<std::string, Factors> no_matter_;  // irrelevant factors by Failure::kind
};

}  // namespace triptych::measure
