#pragma once
#include <filesystem>

#include "scene/volume.hpp"

namespace triptych::scene {

// Reads MetaImage (itk.org/Wiki/MetaIO): a header of "Key = value" lines. The voxels follow the
// header (.mha) or are in separate files (.mhd: one file, a LIST, or a pattern). There are three
// dimensions, or a fourth one whose entries are components, like the channels of a voxel. The data
// are binary or ASCII, in either byte order, compressed or not. The volume is not rotated into the
// patient's space. Keys that do not affect the voxels are ignored. Throws InputError with the line,
// and IoError. The caller sets the volume's name.
[[nodiscard]] Volume read_metaimage(const std::filesystem::path& file,
                                    const Component& component = {});

}  // namespace triptych::scene
