#pragma once
#include <filesystem>

#include "scene/volume.hpp"

namespace triptych::scene {

// Reads NIfTI-1 and NIfTI-2 files (nifti.nimh.nih.gov): a single file (.nii), or a header (.hdr)
// whose voxels are in an .img file next to it, in either byte order, compressed or not. All types
// are supported except complex numbers, 128-bit floats and single bits. The volume is not rotated
// into patient space. The spacings are read from `pixdim`. A spacing of 0 is treated as 1, as in
// the format's reference implementation. `scl_slope` and `scl_inter` are applied. The fourth and
// higher dimensions, and the bytes of RGB and RGBA, become components. Throws InputError and
// IoError. The caller sets the volume's name.
[[nodiscard]] Volume read_nifti(const std::filesystem::path& file, const Component& component = {});

}  // namespace triptych::scene
