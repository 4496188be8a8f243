#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::scene {

// A table of 256 RGBA entries in [0, 1], not premultiplied. Entry k is at (k+½)/256. All four
// channels are linear between the centres of entries, and constant before the first and after the
// last centre. Alpha is the opacity of one voxel length (the smallest spacing), so a step of s
// voxels has the opacity 1 − (1−α)^s.
struct TransferFunction {
  std::string name;
  std::array<std::array<float, 4>, 256> entries{};
};

// Loads a preset ("haze" is mostly transparent, "surfaces" has opaque shells) or a file. A file has
// either 256 lines "R G B A" (with numbers from 0 to 255, or from 0 to 1 if all are ≤ 1), or 1024
// bytes for 256 RGBA8 entries. Empty lines and lines that begin with '#' are skipped. Throws
// InputError with file and line.
[[nodiscard]] TransferFunction load_transfer_function(
    std::string_view name, const std::vector<std::filesystem::path>& folders = {});
// Returns whether all normalised values in [lo, hi] have the opacity 0.
[[nodiscard]] bool is_transparent(const TransferFunction& function, double lo, double hi);
[[nodiscard]] std::vector<std::string_view> transfer_function_presets();

}  // namespace triptych::scene
