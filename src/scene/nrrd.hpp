#pragma once
#include <filesystem>

#include "scene/volume.hpp"

namespace triptych::scene {

// NRRD (teem.sourceforge.net/nrrd/format.html), versions 1 to 5: header and voxels in one file, or
// a detached header naming one `data file`, a LIST of them or a pattern; encodings raw, gzip, bzip2,
// ascii and hex; all spellings of the types but `block`; three axes, or four one of which is
// not spatial and has the components; `spacings`, or `space directions` whose axes are perpendicular
// and of which only the lengths are kept, or `axis mins` and `axis maxs` with `centerings`, else 1;
// `line skip` and `byte skip`. Other fields of the format are allowed and have no effect. Stricter
// than the format in one thing: data after the voxels are an error. Throws InputError with the
// header's line, IoError. The caller sets the volume's name.
[[nodiscard]] Volume read_nrrd(const std::filesystem::path& file, const Component& component = {});

}  // namespace triptych::scene
