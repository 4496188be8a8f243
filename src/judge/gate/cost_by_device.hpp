#pragma once
// What the correlation of costs rests on: each device's cost by configuration, today's and the
// stored one.

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
  std::map<std::string, record::Device> devices;  // of the run, by id
  std::vector<const record::Record*> records;     // measured, with right pictures
  std::map<std::string, DriverCost> stored;       // by Device::statistics_key()
};

struct ConfigurationCost {
  const record::Record* record = nullptr;  // nullptr: of a device that is not in the run
  FrameCost now;                           // of such a device, the stored one
  std::optional<FrameCost> stored = {};    // by the same driver version and the same counter
};

struct DeviceCost {
  std::string id;
  std::string name;        // id; of a device that is not in the run, with its driver version
  std::string counted_by;  // only counts by the same one are held against each other
  bool measured = false;   // in this run
  std::map<std::string, ConfigurationCost> configurations;

  // Some configuration has a stored cost, so that its changes are exact.
  [[nodiscard]] bool accepted() const;
};

// Devices of the run whose instructions were counted, by id, then stored ones that it lacks.
[[nodiscard]] std::vector<DeviceCost> cost_by_device(const CorrelationInput& input);

// "technique" among the factors of a record.
[[nodiscard]] Factors factors_of(const record::Record& record);

// A pair by cost, its line fitted, over the configurations that both have.
[[nodiscard]] CorrelationPair pair_of(const DeviceCost& a, const DeviceCost& b);

// The same by time, each two devices of the run: to be seen, nothing is judged by it.
[[nodiscard]] std::vector<CorrelationPair> pairs_by_time(const CorrelationInput& input);

// The check itself, apart from the gate.
[[nodiscard]] CorrelationFindings correlate(const CorrelationInput& input);

}  // namespace triptych::judge
