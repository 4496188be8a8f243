#pragma once
#include <algorithm>
#include <array>
#include <string_view>

namespace triptych::record {

// The factors that determine Record::data_hash, the content hash of the data that a device draws.
// The hash depends on the levels that are actually used: "auto" is replaced by the level that the
// device chooses.
inline constexpr std::array<std::string_view, 5> data_factors{"data", "voxel", "colour", "window",
                                                              "mapping"};

[[nodiscard]] inline bool determines_data(std::string_view factor) {
  return std::ranges::find(data_factors, factor) != data_factors.end();
}

}  // namespace triptych::record
