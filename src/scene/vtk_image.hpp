#pragma once
#include <filesystem>

#include "scene/volume.hpp"

namespace triptych::scene {

// Reads VTK image data in XML format (.vti) with one piece. The data are ASCII, binary (base64) or
// appended (raw or base64), uncompressed or compressed with zlib, in either byte order. The array
// drawn is the one that the file declares as its scalars, or else the first point array, or else
// the first cell array. Throws InputError and IoError. The caller sets the volume's name.
[[nodiscard]] Volume read_vti(const std::filesystem::path& file, const Component& component = {});

// Reads VTK's legacy format (.vtk), ASCII or BINARY, with the dataset STRUCTURED_POINTS. The first
// array is drawn: SCALARS, COLOR_SCALARS, VECTORS, NORMALS, or the first array of a FIELD. Throws
// InputError with the number of the line, and IoError. The caller sets the volume's name.
[[nodiscard]] Volume read_vtk(const std::filesystem::path& file, const Component& component = {});

}  // namespace triptych::scene
