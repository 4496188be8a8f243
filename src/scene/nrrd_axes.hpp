#pragma once
// Interprets the axes of an NRRD file: which of them are spatial, and their sizes, spacing, unit
// and orientation.

#include <cstddef>
#include <optional>
#include <string>

#include "scene/nrrd_header.hpp"
#include "scene/raw_voxels.hpp"
#include "scene/volume.hpp"

namespace triptych::scene::nrrd {

// The index of the axis that holds the components of a voxel. It is set only if the file has four
// axes. This axis is not spatial, so the volume does not have it, but header fields with one word
// per axis also have a word for this axis.
using ComponentAxis = std::optional<std::size_t>;

// Sets the sizes and, for four axes, the layout of the components. All functions in this file throw
// InputError with file and line.
[[nodiscard]] ComponentAxis parse_axes(const Header& header, Volume& volume, ValueLayout& layout);

// Sets the spacing and the orientation.
void parse_spacing(const Header& header, const ComponentAxis& component_axis, Volume& volume);

// Returns the first unit of the axes, or an empty string if there is none.
[[nodiscard]] std::string unit_of(const Header& header);

}  // namespace triptych::scene::nrrd
