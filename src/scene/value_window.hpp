#pragma once
// The range of a volume's values that the transfer function covers: the factors `window` and
// `mapping`.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/volume.hpp"

namespace triptych::scene {

// One end of a window: a value in the units of the data, or a percentile of the voxels.
struct WindowEnd {
  double number = 0;
  bool percentile = false;
};

struct Window {
  WindowEnd lo;
  WindowEnd hi;
};

// "full" means no window, but the range of the volume. Otherwise the text is LOW..HIGH, and each of
// them is a number or pN with 0 ≤ N ≤ 100: "0.5..3", "p1..p99", "0..p99.5". Throws InputError for
// any other text, and for two numbers or two percentiles if the first is not smaller than the
// second.
[[nodiscard]] std::optional<Window> parse_window(std::string_view text);

// "linear" or "log"; throws InputError.
[[nodiscard]] Mapping mapping(std::string_view name);

// Sets the values that encode maps to 0 and to 1, and the kind of mapping. Values outside the
// window are clamped to its ends, voxel by voxel, before anything is interpolated. Percentiles are
// nearest ranks: the smallest value that at least N % of the voxels do not exceed. Values that are
// not finite do not count; for a logarithm only positive values count, and its full range begins at
// the smallest of them. The full range with a linear mapping does not change the volume. Throws
// InputError for a window that is empty for these voxels, for a logarithm if no voxel is positive,
// and for a logarithm with a window that does not begin above 0.
void set_window(Volume& volume, const std::optional<Window>& window, Mapping mapping);

}  // namespace triptych::scene
