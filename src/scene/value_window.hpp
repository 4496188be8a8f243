#pragma once
// The range of a volume's values that the transfer function covers, as set by the factors
// (settings) `window` and `mapping`.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/volume.hpp"

namespace triptych::scene {

// One end of a window: a number in the units of the data, or a percentile of the voxels' values.
struct WindowEnd {
  double number = 0;
  bool percentile = false;
};

struct Window {
  WindowEnd lo;
  WindowEnd hi;
};

// Parses a window. Returns nullopt for "full", which means the full range of the volume. Any other
// window has the form LOW..HIGH, where each end is a number or pN with 0 ≤ N ≤ 100: "0.5..3",
// "p1..p99", "0..p99.5". Throws InputError for any other text, and for two numbers or two
// percentiles if the first is not smaller than the second.
[[nodiscard]] std::optional<Window> parse_window(std::string_view text);

// Parses "linear" or "log". Throws InputError for any other name.
[[nodiscard]] Mapping mapping(std::string_view name);

// Sets the values that encode() maps to 0 and 1, and whether the mapping is linear or logarithmic.
// Each voxel outside the window is clamped to the window's ends before anything is interpolated.
// The percentile pN is the smallest value for which at least N % of the voxels are not larger
// (nearest rank). Values that are not finite are ignored. With a logarithmic mapping, only positive
// values are used, and the full range begins at the smallest positive value. The full range with a
// linear mapping leaves the volume unchanged. Throws InputError if there are no usable values, if
// the window's lower end is not below its upper end for these voxels, or if the mapping is
// logarithmic and the window does not begin above 0. If nearly all values are below the window, or
// nearly all are above it, adds a note to the volume's facts.
void set_window(Volume& volume, const std::optional<Window>& window, Mapping mapping);

}  // namespace triptych::scene
