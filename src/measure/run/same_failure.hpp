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
    record::Reason reason;  // that of the configurations that were tried, marked as not tried, with
                            // the levels that they share
  };
  // The predicted end of the configuration. It is predicted to end like one that crashed, hung or
  // lost the device under two conditions: it differs from that one only in irrelevant factors
  // (those in which two configurations differ that ended in the same way), and no configuration
  // that differs only in such factors was measured. nullopt: it has to be tried.
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
  std::map<std::string, Factors> no_matter_;  // by kind
};

}  // namespace triptych::measure
