#pragma once
#include <filesystem>

#include "scene/volume.hpp"

namespace triptych::scene {

// Reads a .dat description and the raw voxels, which are in a separate file next to it. The
// description consists of lines "Key: value", whose keys may be in upper or lower case:
// clang-format off
//   ObjectFileName   the raw file (required)
//   Resolution       the sizes along x, y and z (required)
//   Format           UCHAR, CHAR, USHORT, SHORT, UINT, INT, FLOAT or DOUBLE (required)
//   SliceThickness   the spacings along x, y and z; the default is 1 1 1
//   Endianness       LITTLE or BIG; the default is LITTLE. The spelling Endianess is also accepted.
// clang-format on
// TimeStep, TaggedFileName, NbrTags, ObjectType, ObjectModel, GridType and Modality are accepted
// and ignored. Any other key is an error, as is extra data after the voxels. The caller sets the
// volume's name. Throws InputError with the number of the line, and IoError.
[[nodiscard]] Volume read_dat(const std::filesystem::path& file, const Component& component = {});

}  // namespace triptych::scene
