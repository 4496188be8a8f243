#pragma once
#include <filesystem>

#include "scene/volume.hpp"

namespace triptych::scene {

// Reads NRRD files (teem.sourceforge.net/nrrd/format.html), versions 1 to 5. Header and voxels are
// in one file, or a detached header names one `data file`, a LIST of files, or a pattern. The
// encodings are raw, gzip, bzip2, ascii and hex. All types except `block` are supported, in all
// their spellings. There are three axes, or four if one of them is not spatial, in which case that
// axis holds the components. The spacing comes from `spacings`, or from `space directions` whose
// axes are perpendicular (only their lengths are used), or from `axis mins` and `axis maxs` with
// `centerings`; otherwise it is 1. `line skip` and `byte skip` are supported. Other fields of the
// format are accepted and ignored. The reader is stricter than the format in one respect: data
// after the voxels are an error. Throws InputError with the header's line, and IoError. The caller
// sets the volume's name.
[[nodiscard]] Volume read_nrrd(const std::filesystem::path& file, const Component& component = {});

}  // namespace triptych::scene
