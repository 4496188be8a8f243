#pragma once
// The location of an NRRD file's values: in the file itself, in another one, or in several.

#include <filesystem>

#include "scene/nrrd_header.hpp"
#include "scene/raw_voxels.hpp"

namespace triptych::scene::nrrd {

// Finds the files, the encoding, and the bytes or lines to skip before the values. The caller
// determines the layout of the values. Throws InputError with file and line.
[[nodiscard]] RawVoxels locate(const Header& header, const std::filesystem::path& file);

}  // namespace triptych::scene::nrrd
