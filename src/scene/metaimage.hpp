#pragma once
#include <filesystem>

#include "scene/volume.hpp"

namespace triptych::scene {

// MetaImage (itk.org/Wiki/MetaIO): a header of "Key = value" lines with its voxels behind it (.mha)
// or in files of their own (.mhd: one, a LIST, or a pattern). Three dimensions, or four, of which
// the last one are components, as are the channels of a voxel; binary or ASCII, either byte order,
// compressed or not. The volume keeps its own axes. Keys that do not bear on the voxels have no
// effect. Throws InputError with the line, IoError. The caller sets the volume's name.
[[nodiscard]] Volume read_metaimage(const std::filesystem::path& file,
                                    const Component& component = {});

}  // namespace triptych::scene
