#pragma once
// The table of volume formats, with one row per format. docs/adding-a-file-format.md describes how
// to add a format.

#include <filesystem>
#include <span>
#include <string_view>

#include "scene/volume.hpp"

namespace triptych::scene {

struct VolumeFormat {
  std::string_view name;
  std::string_view endings;  // in lower case, separated by blanks; the usual ending comes first
  // Returns whether the beginning of the decompressed content identifies this format unambiguously.
  bool (*begins)(std::string_view start);
  Volume (*read)(const std::filesystem::path& file, const Component& component);
};

[[nodiscard]] std::span<const VolumeFormat> volume_formats();

// Determines the format of a file from its name (ignoring .gz or .bz2), or from the beginning of
// its content if no format has that ending. Throws InputError if neither identifies a format, or if
// they identify different formats.
[[nodiscard]] const VolumeFormat& volume_format(const std::filesystem::path& file);

}  // namespace triptych::scene
