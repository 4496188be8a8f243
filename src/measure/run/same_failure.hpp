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
    std::string reason;  // as of those that were tried, then record::not_tried and what they share
  };
  // How the configuration would end: as one that crashed, hung or lost the device, if it differs
  // from that one only in factors that were seen not to matter – two that ended with the same words
  // differ in them alone – and nothing that differs so was measured. Nothing: try it.
  [[nodiscard]] std::optional<Foretold> foretold(const Configuration& configuration) const;

 private:
  using Factors = std::set<std::string>;
  struct Failure {
    Configuration configuration;
    record::Outcome outcome;
    std::string reason;
    std::string words;  // outcome and reason, but for numbers
  };
  [[nodiscard]] bool is_refuted(const Configuration& configuration, const Factors& but_for) const;

  std::vector<std::string> varied_;
  std::vector<Configuration> measured_;
  std::vector<Failure> failures_;
  std::map<std::string, Factors> no_matter_;  // by words
};

}  // namespace triptych::measure
