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
  std::vector<const record::Record*> records;     // measured records with right images
  std::map<std::string, DriverCost> stored;       // by Device::statistics_key()
};

struct ConfigurationCost {
  const record::Record* record = nullptr;  // nullptr: the device is not in the run
  FrameCost now;                           // for a device that is not in the run, the stored one
  std::optional<FrameCost> stored = {};    // for the same driver version, by the same counter
};

struct DeviceCost {
  std::string id;
  std::string name;        // the id; with the driver version if the device is not in the run
  std::string counted_by;  // only counts by the same one are compared
  bool measured = false;   // in this run
  std::map<std::string, ConfigurationCost> configurations;

  // Whether at least one configuration has a stored cost, so that changes since then are known.
  [[nodiscard]] bool accepted() const;
};

// The devices of the run whose instructions were counted, by id, and then stored devices that are
// not in the run.
[[nodiscard]] std::vector<DeviceCost> cost_by_device(const CorrelationInput& input);

// The factors of a record, with its technique as the factor "technique".
[[nodiscard]] Factors factors_of(const record::Record& record);

// The pair by cost over all configurations that both have, with its line fitted.
[[nodiscard]] CorrelationPair pair_of(const DeviceCost& a, const DeviceCost& b);

// The pairs by time, for all devices of the run. They are only shown and do not affect the verdict.
[[nodiscard]] std::vector<CorrelationPair> pairs_by_time(const CorrelationInput& input);

// The check itself, without the gate.
[[nodiscard]] CorrelationFindings correlate(const CorrelationInput& input);

}  // namespace triptych::judge
