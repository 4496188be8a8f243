#pragma once
// Avoids trying configurations that are likely to fail. A driver fault that ends the worker usually
// affects many configurations, and each of them would require a new worker or take up the whole
// time limit. Therefore, after two configurations have failed in the same way, similar
// configurations are not tried.

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "measure/contract/suite.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// Predicts which configurations of a plan fail on a device, from the failures so far.
class FailurePredictor {
 public:
  // `varied` contains the factors that have more than one value in the plan. Reasons state the
  // levels of these factors.
  explicit FailurePredictor(std::vector<std::string> varied) : varied_(std::move(varied)) {}

  void add(const Configuration& configuration, const record::Record& record);

  struct Prediction {
    record::Outcome outcome;
    // The reason why the tried configurations failed, with the levels that they share. Its member
    // `not_tried` is true.
    record::Reason reason;
  };
  // Returns the predicted outcome of the configuration, or nullopt if it has to be tried. If two
  // configurations failed in the same way, the factors in which they differ are irrelevant for this
  // failure, unless a configuration that differs from the second one only in these factors was
  // measured successfully. A configuration is predicted to fail like an earlier configuration that
  // crashed, hung or lost the device if both of these conditions are met:
  // - The two configurations differ only in irrelevant factors.
  // - No configuration that differs from the earlier configuration only in irrelevant factors was
  //   measured successfully.
  [[nodiscard]] std::optional<Prediction> predict(const Configuration& configuration) const;

 private:
  using Factors = std::set<std::string>;
  struct Failure {
    Configuration configuration;
    record::Outcome outcome;
    record::Reason reason;
    std::string kind;  // kind of outcome and reason
  };
  [[nodiscard]] bool is_refuted(const Configuration& configuration, const Factors& ignored) const;

  std::vector<std::string> varied_;
  std::vector<Configuration> measured_;
  std::vector<Failure> failures_;
  std::map<std::string, Factors> irrelevant_;  // irrelevant factors by Failure::kind
};

}  // namespace triptych::measure
