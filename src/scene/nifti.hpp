#pragma once
#include <filesystem>

#include "scene/volume.hpp"

namespace triptych::scene {

// Reads NIfTI-1 and NIfTI-2 (nifti.nimh.nih.gov): one file (.nii), or a header (.hdr) with its
// voxels in an .img file next to it, in either byte order, uncompressed or compressed. All types
// are supported except complex numbers, 128-bit floats and single bits. The volume is not rotated
// into the patient's space. Spacings are `pixdim`, where 0 counts as 1, as in the format's own
// library. `scl_slope` and `scl_inter` are applied. A fourth and higher dimensions, and the bytes
// of RGB and RGBA, are components. Throws InputError and IoError. The caller sets the volume's
// name.
[[nodiscard]] Volume read_nifti(const std::filesystem::path& file, const Component& component = {});

}  // namespace triptych::scene
