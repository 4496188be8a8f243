#pragma once
// A fault of a driver that ends its worker meets many configurations, and each costs a worker or
// the whole limit. What two have shown is not tried on the rest.

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
  // `varied`: the factors that the reason names, in which the plan's configurations differ.
  explicit SameFailure(std::vector<std::string> varied) : varied_(std::move(varied)) {}

  void saw(const Configuration& configuration, const record::Record& record);

  struct Foretold {
    record::Outcome outcome;
    record::Reason
        reason;  // as of those that were tried, marked as not tried, with what they share
  };
  // How the configuration would end: as one that crashed, hung or lost the device, if it differs
  // from that one only in factors that were seen not to matter – two that ended in the same way
  // differ in them alone – and nothing that differs so was measured. Nothing: try it.
  [[nodiscard]] std::optional<Foretold> foretold(const Configuration& configuration) const;

 private:
  using Factors = std::set<std::string>;
  struct Failure {
    Configuration configuration;
    record::Outcome outcome;
    record::Reason reason;
    std::string kind;  // of outcome and reason
  };
  [[nodiscard]] bool is_refuted(const Configuration& configuration, const Factors& but_for) const;

  std::vector<std::string> varied_;
  std::vector<Configuration> measured_;
  std::vector<Failure> failures_;
  std::map<std::string, Factors> no_matter_;  // by kind
};

}  // namespace triptych::measure
