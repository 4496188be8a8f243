#pragma once
// Locates the voxel values of an NRRD file, which are in the file itself, in another file, or in
// several files.

#include <filesystem>

#include "scene/nrrd_header.hpp"
#include "scene/raw_voxels.hpp"

namespace triptych::scene::nrrd {

// Finds the files, the encoding, and the number of bytes or lines to skip before the values. Leaves
// the layout of the values to be set by the caller. Throws InputError with file and line.
[[nodiscard]] RawVoxels locate(const Header& header, const std::filesystem::path& file);

}  // namespace triptych::scene::nrrd
