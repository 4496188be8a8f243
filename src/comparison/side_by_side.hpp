#pragma once
// A table with the cost or time of each technique on each device, relative to the best device for
// that technique.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "record/record.hpp"

namespace triptych::comparison {

// All values are geometric means over the configurations that were measured on every device in the
// row. A geometric mean prevents a large scene from outweighing the others.
struct SideBySide {
  struct Cell {
    double value = 0;  // instructions or nanoseconds per frame
    double ratio = 1;  // relative to the best device of the row
    // Counters of this device, divided by the same counters of the best device. They explain why
    // the values differ.
    std::map<std::string, double> work = {};
  };
  struct Row {
    std::string technique;
    std::size_t configurations = 0;
    std::string best;  // the best device
    // The cells by device. A device that does not support the technique has no cell.
    std::map<std::string, Cell> cells;
  };
  std::string unit;   // "instructions" or "ns"
  std::string clock;  // "device" or "wall"; empty if the unit is not "ns"
  std::vector<std::string> devices;
  std::vector<Row> rows;
};

// Returns the table for one run. The table contains instructions if they were counted on at least
// two devices, and times otherwise. The times are device times if the clocks of all devices are
// trusted, and wall-clock times otherwise. Returns nullopt if no configuration was measured on at
// least two devices.
[[nodiscard]] std::optional<SideBySide> side_by_side(std::span<const record::Record> records);

}  // namespace triptych::comparison
