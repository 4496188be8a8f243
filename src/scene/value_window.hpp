#pragma once
// Which of a volume's values the transfer function sees: the factors `window` and `mapping`.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/volume.hpp"

namespace triptych::scene {

// One end of a window: a value in the data's own units, or a percentile of the voxels.
struct WindowEnd {
  double number = 0;
  bool percentile = false;
};

struct Window {
  WindowEnd lo;
  WindowEnd hi;
};

// "full" is no window: the volume's own range. Else LOW..HIGH, either a number or pN, 0 ≤ N ≤ 100:
// "0.5..3", "p1..p99", "0..p99.5". Throws InputError for what is neither, and for two numbers or
// two percentiles of which the first is not the smaller one.
[[nodiscard]] std::optional<Window> parse_window(std::string_view text);

// "linear" or "log"; throws InputError.
[[nodiscard]] Mapping mapping(std::string_view name);

// Sets what encode maps to 0 and 1, and how. Values beyond the window are clamped to its ends,
// voxel by voxel and before anything is interpolated. Percentiles are nearest ranks: the smallest
// value that at least N % of the voxels do not exceed. What is not finite does not count; a
// logarithm counts positive values alone, and its full range begins at the smallest of them. The
// full range with a linear mapping leaves the volume as it is. Throws InputError for a window that
// is empty for these voxels, and for a logarithm of none that is positive or from a window that
// does not begin above 0.
void set_window(Volume& volume, const std::optional<Window>& window, Mapping mapping);

}  // namespace triptych::scene
