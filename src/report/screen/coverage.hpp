#pragma once
// The coverage of a validation: the levels and sizes that its records have drawn, so that a pass
// states what it covers.

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "core/json.hpp"
#include "record/record.hpp"

namespace triptych::report {

struct Largest {
  std::uint64_t value = 0;
  std::string configuration;  // the first configuration with this value
};

struct Coverage {
  std::size_t configurations = 0;  // number of measured configurations
  // Levels by factor, for factors with few levels.
  std::map<std::string, std::set<std::string>> levels;
  // Largest value of one frame, by counter, statistic or kind of memory.
  std::map<std::string, Largest> largest;
};

// Coverage by device. Records that were not measured do not count.
[[nodiscard]] std::map<std::string, Coverage> coverage_of(std::span<const record::Record> records);

// A scene in which a correct image may differ from the reference by more than a step of 8 bits.
struct WideBound {
  std::string device;
  std::string configuration;
  double bound = 0;  // the largest bound of a channel, over pixels whose particle is certain
  // Explains a large bound, because each sample may be rounded; 0 without rays.
  double samples_per_ray = 0;
};
inline constexpr double one_step = 1.0 / 255;

// The largest bound of a reference image; pixels whose particle is not certain are left out,
// because their bound covers other particles.
[[nodiscard]] double largest_bound(const core::Image& bound);
[[nodiscard]] std::string bounds_text(std::vector<WideBound> bounds);

[[nodiscard]] std::string coverage_text(const std::map<std::string, Coverage>& coverage);
[[nodiscard]] core::Json coverage_json(const std::map<std::string, Coverage>& coverage);

}  // namespace triptych::report
