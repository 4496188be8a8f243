#pragma once
#include <filesystem>

#include "scene/volume.hpp"

namespace triptych::scene {

// VTK image data as XML (.vti): one piece; ASCII, binary (base64) or appended (raw or base64) data,
// plain or compressed with zlib, either byte order. Drawn is the array that the file calls its
// scalars, else the first one, of the points, else of the cells. Throws InputError, IoError. The
// caller sets the volume's name.
[[nodiscard]] Volume read_vti(const std::filesystem::path& file, const Component& component = {});

// VTK's legacy format (.vtk) with the dataset STRUCTURED_POINTS, ASCII or BINARY. Drawn is its first
// array: SCALARS, COLOR_SCALARS, VECTORS, NORMALS, or the first one of a FIELD. Throws InputError
// with the line, IoError. The caller sets the volume's name.
[[nodiscard]] Volume read_vtk(const std::filesystem::path& file, const Component& component = {});

}  // namespace triptych::scene
