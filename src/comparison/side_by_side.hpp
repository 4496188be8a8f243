#pragma once
// A table with the cost or time of each technique on each device, relative to the best device for
// that technique, with confidence intervals for times.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "comparison/pairwise.hpp"
#include "record/record.hpp"

namespace triptych::comparison {

// All values are geometric means over the configurations that were measured on every device in the
// row. A geometric mean prevents a large scene from outweighing the others.
struct SideBySide {
  struct Cell {
    double value = 0;  // instructions or nanoseconds per frame
    double ratio = 1;  // relative to the best device of the row
    // The 98 % confidence interval of ln(ratio). It is {0, 0} for the best device and for
    // instructions, which are exact, and nullopt if there are too few samples. If there are several
    // runs of both devices, it comes from the variation between the runs, and otherwise from the
    // variation between the frames of one run.
    std::optional<Interval> interval = Interval{};
    // Counters of this device, divided by the same counters of the best device. They explain why
    // the values differ.
    std::map<std::string, double> work = {};

    // Returns whether this device is certainly worse than the best device.
    [[nodiscard]] bool is_significant() const { return interval && interval->low > 0; }
  };
  struct Row {
    std::string technique;
    std::size_t configurations = 0;
    std::string best;  // the best device
    // The cells by device. A device that does not support the technique has no cell.
    std::map<std::string, Cell> cells;

    // Returns whether all other devices are certainly worse than the best device.
    [[nodiscard]] bool is_significant() const;
  };
  std::string unit;              // "instructions" or "ns"
  std::string clock;             // "device" or "wall"; empty if the unit is not "ns"
  std::size_t process_runs = 1;  // the smallest number of complete runs of any device in any row
  std::vector<std::string> devices;
  std::vector<Row> rows;

  [[nodiscard]] bool is_time() const { return !clock.empty(); }
};

// Returns the table for the first run of each device in `records`. If there are further runs of the
// same plan and device (Record::run), each of them was measured by other worker processes, so they
// are used for means and confidence intervals if they contain all configurations of a row.
//
// The table contains instructions if they were counted on at least two devices, and times
// otherwise. The times are device times if the clocks of all devices are trusted, and wall-clock
// times otherwise. Returns nullopt if no configuration was measured on at least two devices.
[[nodiscard]] std::optional<SideBySide> side_by_side(std::span<const record::Record> records);

}  // namespace triptych::comparison
