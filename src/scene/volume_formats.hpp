#pragma once
// The table of volume formats: one row each. docs/adding-a-file-format.md says how to add one.

#include <filesystem>
#include <span>
#include <string_view>

#include "scene/volume.hpp"

namespace triptych::scene {

struct VolumeFormat {
  std::string_view name;
  std::string_view endings;  // in small letters, separated by blanks; the first one is the usual one
  // Whether the unpacked content of a file begins as one of this format, beyond doubt.
  bool (*begins)(std::string_view start);
  Volume (*read)(const std::filesystem::path& file, const Component& component);
};

[[nodiscard]] std::span<const VolumeFormat> volume_formats();

// The format of a file by its name, without .gz or .bz2, or where no format has that name by how its
// content begins. Throws InputError where it has none, and for content that is of another format
// than the name says.
[[nodiscard]] const VolumeFormat& volume_format(const std::filesystem::path& file);

}  // namespace triptych::scene
