#pragma once
// The table of volume formats, with one row for each. docs/adding-a-file-format.md describes how to
// add one.

#include <filesystem>
#include <span>
#include <string_view>

#include "scene/volume.hpp"

namespace triptych::scene {

struct VolumeFormat {
  std::string_view name;
  std::string_view endings;  // in lower case, separated by blanks; the first one is the usual one
  // Whether the beginning of the unpacked content identifies this format without doubt.
  bool (*begins)(std::string_view start);
  Volume (*read)(const std::filesystem::path& file, const Component& component);
};

[[nodiscard]] std::span<const VolumeFormat> volume_formats();

// Determines the format of a file from its name (without .gz or .bz2), or from the beginning of its
// content if no format has that ending. Throws InputError if neither identifies a format, or if the
// content has another format than the name.
[[nodiscard]] const VolumeFormat& volume_format(const std::filesystem::path& file);

}  // namespace triptych::scene
