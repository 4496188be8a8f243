#pragma once
// Finds, for each device, the step and the threshold of early ray termination that use up a
// requested error. The devices draw trial images for this purpose.

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/error_budget.hpp"
#include "measure/request/error_request.hpp"

namespace triptych::measure {

// The settings from which the trials start, for one scene and one quadrature.
struct ErrorStart {
  std::string scene;
  Configuration configuration;  // all levels except those of `step` and `ert`
  accuracy::BudgetSearch search;
};

class ErrorTrials {
 public:
  ErrorTrials(const Plan& plan, const ErrorSearch& search, std::vector<ErrorStart> starts);

  // Draws trial images until the search of every device has ended. Returns the configurations with
  // the fewest samples that meet the error, for each scene, quadrature and device. If a device
  // finds none in a scene, returns the configurations with the smallest errors.
  [[nodiscard]] std::vector<Configuration> run();

 private:
  struct Trial {
    std::size_t start = 0;  // index in starts_
    accuracy::BudgetPlace place;
  };
  using Searches = std::map<std::string, accuracy::BudgetSearch>;  // by device

  [[nodiscard]] Configuration configuration_of(const Trial& trial) const;
  // Draws the trials, and adds their errors to the searches of the devices.
  void draw(const std::map<std::string, Trial>& trials);
  [[nodiscard]] std::vector<Configuration> chosen() const;

  Plan plan_;  // for the trials; without configurations
  const ErrorSearch& search_;
  std::vector<ErrorStart> starts_;
  std::vector<Searches> searches_;  // in the same order as starts_
};

}  // namespace triptych::measure
