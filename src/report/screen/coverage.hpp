#pragma once
// The coverage of a validation: the factor levels that were drawn and the largest counts that
// occurred. It shows what a pass covers.

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
  // The levels that were drawn, by factor, for factors with few levels.
  std::map<std::string, std::set<std::string>> levels;
  // The largest value in any frame, by counter, statistic or kind of memory.
  std::map<std::string, Largest> largest;
};

// Returns the coverage by device. Ignores records that were not measured.
[[nodiscard]] std::map<std::string, Coverage> coverage_of(std::span<const record::Record> records);

// A scene in which a correct image may differ from the reference image by more than one 8-bit step.
struct WideBound {
  std::string device;
  std::string configuration;
  double bound = 0;  // see largest_bound()
  // Mean number of samples per ray, which explains a large bound: each sample adds rounding errors.
  // 0 if there are no rays.
  double samples_per_ray = 0;
};
inline constexpr double eight_bit_step = 1.0 / 255;

// Returns the largest error bound of any pixel. Ignores pixels in which rounding may make another
// particle visible, because their bounds also allow the colours of that particle.
[[nodiscard]] double largest_bound(const core::Image& bound);
[[nodiscard]] std::string bounds_text(std::vector<WideBound> bounds);

// Returns all levels and largest values of each device.
[[nodiscard]] std::string coverage_text(const std::map<std::string, Coverage>& coverage);
// Returns a line for each device, or a single line for all devices if there are many: how many
// configurations, factors and levels were drawn.
[[nodiscard]] std::string coverage_summary(const std::map<std::string, Coverage>& coverage);
[[nodiscard]] core::Json coverage_json(const std::map<std::string, Coverage>& coverage);

}  // namespace triptych::report
