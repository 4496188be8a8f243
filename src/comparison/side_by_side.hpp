#pragma once
// A table with the cost or time of each technique on each device, relative to the best device.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "record/record.hpp"

namespace triptych::comparison {

// Means are geometric, over the configurations that all devices of the row measured, so that no
// large scene outweighs the others.
struct SideBySide {
  struct Cell {
    double value = 0;  // instructions or nanoseconds per frame
    double ratio = 1;  // to the best device of the row
    // Counters that explain the difference, as ratios to the best device.
    std::map<std::string, double> work = {};
  };
  struct Row {
    std::string technique;
    std::size_t configurations = 0;
    std::string best;  // device
    // By device; absent if the device does not have the technique.
    std::map<std::string, Cell> cells;
  };
  std::string unit;   // "instructions" or "ns"
  std::string clock;  // for times "device" or "wall"
  std::vector<std::string> devices;
  std::vector<Row> rows;
};

// The table of one run. It contains instructions if at least two devices counted them, otherwise
// times: by the device clock if all of them trust it, otherwise by the wall clock. nullopt if no
// configuration was measured by two devices.
[[nodiscard]] std::optional<SideBySide> side_by_side(std::span<const record::Record> records);

}  // namespace triptych::comparison
