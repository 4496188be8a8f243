#pragma once
// The data for the correlation of costs: the current and the stored cost of each configuration on
// each device.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "judge/correlation/factor_levels.hpp"
#include "judge/correlation/pair.hpp"
#include "judge/correlation/residuals.hpp"
#include "judge/gate/run_view.hpp"

namespace triptych::judge {

struct CorrelationInput {
  std::map<std::string, record::Device> devices;  // the devices of the run, by id
  std::vector<const record::Record*> records;     // measured records with correct images
  std::map<std::string, DriverCost> stored;       // by Device::statistics_key()
};

struct ConfigurationCost {
  const record::Record* record = nullptr;  // nullptr: the device is not in the run
  FrameCost now;                           // the stored cost, if the device is not in the run
  std::optional<FrameCost> stored = {};    // from the same driver version and emulator as `now`
};

struct DeviceCost {
  std::string id;
  std::string name;        // the id, followed by the driver version if the run lacks the device
  std::string counted_by;  // the emulator; only counts from the same emulator are compared
  bool measured = false;   // whether the device was measured in this run
  std::map<std::string, ConfigurationCost> configurations;

  // Returns whether at least one configuration has a stored cost with which the current one is
  // compared.
  [[nodiscard]] bool accepted() const;
};

// Returns the devices of the run whose instructions were counted, sorted by id, followed by stored
// devices that are not in the run.
[[nodiscard]] std::vector<DeviceCost> cost_by_device(const CorrelationInput& input);

// Returns the factors of a record, including its technique as the factor "technique".
[[nodiscard]] Factors factors_of(const record::Record& record);

// Pairs the costs of all configurations that were measured on both devices, and fits a line to
// them.
[[nodiscard]] CorrelationPair pair_of(const DeviceCost& a, const DeviceCost& b);

// Pairs the frame times of every two devices in the run. The report shows these pairs, but they do
// not affect the verdict.
[[nodiscard]] std::vector<CorrelationPair> pairs_by_time(const CorrelationInput& input);

// Runs the check `correlation` on this input.
[[nodiscard]] CorrelationFindings correlate(const CorrelationInput& input);

}  // namespace triptych::judge
