#pragma once
#include <filesystem>

#include "scene/volume.hpp"

namespace triptych::scene {

// MetaImage (itk.org/Wiki/MetaIO): a header of "Key = value" lines. The voxels follow it (.mha) or
// are in separate files (.mhd: one, a LIST, or a pattern). There are three dimensions, or four, of
// which the last one has the components, like the channels of a voxel. The data are binary or
// ASCII, in either byte order, compressed or not. The volume keeps its own axes. Keys that do not
// affect the voxels are ignored. Throws InputError with the line, IoError. The caller sets the
// volume's name.
[[nodiscard]] Volume read_metaimage(const std::filesystem::path& file,
                                    const Component& component = {});

}  // namespace triptych::scene
