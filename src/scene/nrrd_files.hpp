#pragma once
// Locates the values of an NRRD file: in the file itself, in another file, or in several.

#include <filesystem>

#include "scene/nrrd_header.hpp"
#include "scene/raw_voxels.hpp"

namespace triptych::scene::nrrd {

// Finds the files, the encoding, and the bytes or lines to skip before the values. The layout of
// the values is left for the caller to set. Throws InputError with file and line.
[[nodiscard]] RawVoxels locate(const Header& header, const std::filesystem::path& file);

}  // namespace triptych::scene::nrrd
