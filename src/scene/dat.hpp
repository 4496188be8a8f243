#pragma once
#include <filesystem>

#include "scene/volume.hpp"

namespace triptych::scene {

// A .dat description with its raw voxels in a file beside it. Lines "Key: value", keys in any case:
// clang-format off
//   ObjectFileName   the raw file                               required
//   Resolution       sizes along x, y, z                        required
//   Format           UCHAR, CHAR, USHORT, SHORT, UINT, INT, FLOAT, DOUBLE: required
//   SliceThickness   spacings along x, y, z                     1 1 1 where missing
//   Endianness       LITTLE or BIG; Endianess, too              LITTLE where missing
// clang-format on
// TimeStep, TaggedFileName, NbrTags, ObjectType, ObjectModel, GridType and Modality are allowed and have no
// effect; any other key is an error, as is anything after the voxels. The caller sets the volume's
// name. Throws InputError with the line, IoError.
[[nodiscard]] Volume read_dat(const std::filesystem::path& file,
                              const Component& component = {});

}  // namespace triptych::scene
