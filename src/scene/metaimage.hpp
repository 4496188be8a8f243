#pragma once
#include <filesystem>

#include "scene/volume.hpp"

namespace triptych::scene {

// Reads MetaImage files (itk.org/Wiki/MetaIO). The header consists of "Key = value" lines. The
// voxels follow the header (.mha) or are in separate files (.mhd with one file name or a LIST of
// names). A volume has three dimensions. A fourth dimension is read as components, like the
// channels of a voxel. The data are binary or ASCII, in either byte order, compressed or not. The
// volume is not rotated into patient space. Keys that do not affect the voxels are ignored. Throws
// InputError with the number of the line, and IoError. The caller sets the volume's name.
[[nodiscard]] Volume read_metaimage(const std::filesystem::path& file,
                                    const Component& component = {});

}  // namespace triptych::scene
