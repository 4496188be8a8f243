#pragma once
// Devices side by side: what each technique costs on each, against the one that does it best.

#include <map>
#include <nlohmann/json.hpp>
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
    double value = 0;                         // instructions, or nanoseconds, a frame
    double ratio = 1;                         // to the best device of the row
    std::map<std::string, double> work = {};  // counters that tell why, ratios to the best device
  };
  struct Row {
    std::string technique;
    std::size_t configurations = 0;
    std::string best;                   // device
    std::map<std::string, Cell> cells;  // by device; not there where it has no such technique
  };
  std::string unit;   // "instructions" or "ns"
  std::string clock;  // of times "device" or "wall"
  std::vector<std::string> devices;
  std::vector<Row> rows;

  // "gl:x is the best in 5 of 8 techniques; vulkan:y takes 0.98 to 1.3 times as much"; of two
  // devices or more.
  [[nodiscard]] std::string sentence() const;
};

// Of one run. Instructions where they were counted on two devices at least, else times: by the
// device clock where that counts for all of them, else by the wall clock; nothing where fewer than
// two devices measured one configuration.
[[nodiscard]] std::optional<SideBySide> side_by_side(std::span<const record::Record> records);

[[nodiscard]] std::string to_text(const SideBySide& table);
[[nodiscard]] nlohmann::json to_json(const SideBySide& table);

}  // namespace triptych::comparison
