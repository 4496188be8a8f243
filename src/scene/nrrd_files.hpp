#pragma once
// Where the values of an NRRD file are: in the file itself, in another one, or in several.

#include <filesystem>

#include "scene/nrrd_header.hpp"
#include "scene/raw_voxels.hpp"

namespace triptych::scene::nrrd {

// Finds the files, the encoding, and what is skipped before the values. The layout of the values is
// left to the caller. Throws InputError with file and line.
[[nodiscard]] RawVoxels locate(const Header& header, const std::filesystem::path& file);

}  // namespace triptych::scene::nrrd
