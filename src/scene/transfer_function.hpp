#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::scene {

// 256 entries of straight (not premultiplied) RGBA in [0, 1]. Entry k stands at (k+½)/256; between
// entry centres all four channels are linear, outside they are constant. Alpha is the opacity of
// one voxel length (the smallest spacing): a step of s voxels has opacity 1 − (1−α)^s.
struct TransferFunction {
  std::string name;
  std::array<std::array<float, 4>, 256> entries{};
};

// A preset ("haze": mostly transparent; "surfaces": opaque shells) or a file of 256 lines "R G B A"
// (numbers 0..255, or 0..1 where all are ≤ 1) or the 1024 bytes of 256 RGBA8 entries.
// Throws InputError with file and line.
[[nodiscard]] TransferFunction load_transfer_function(
    std::string_view name, const std::vector<std::filesystem::path>& folders = {});
[[nodiscard]] std::vector<std::string_view> transfer_function_presets();

}  // namespace triptych::scene
