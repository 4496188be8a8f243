#pragma once
// A fault of a driver that ends its worker meets many configurations, and each costs a worker or
// the whole limit. What two have shown is not tried on the rest.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "measure/suite.hpp"
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
  // How the configuration would end: as two of its technique that crashed, hung or lost the device
  // with the same words, if it has all levels that those two share, and nothing with all these
  // levels was measured. Nothing: try it.
  [[nodiscard]] std::optional<Foretold> foretold(const Configuration& configuration) const;

 private:
  struct Failure {
    Configuration configuration;
    record::Outcome outcome;
    std::string reason;
  };
  struct Cause {
    Configuration shared;  // by two failures
    Failure failure;
  };
  [[nodiscard]] bool is_refuted(const Cause& cause) const;

  std::vector<std::string> varied_;
  std::vector<Configuration> measured_;
  std::vector<Failure> failures_;
  std::vector<Cause> causes_;
};

}  // namespace triptych::measure
