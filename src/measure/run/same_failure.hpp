#pragma once
// A fault in a driver that ends the worker usually affects many configurations, and each of them
// costs a worker or the whole time limit. If two configurations have failed in the same way,
// similar ones are therefore not tried.

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
  // The predicted outcome of the configuration; nullopt if it has to be tried. A factor is
  // irrelevant if two configurations that differ in it failed in the same way. A configuration is
  // predicted to fail like one that crashed, hung or lost the device if it differs from that one
  // only in irrelevant factors, and if no configuration that differs from it only in these factors
  // was measured.
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
