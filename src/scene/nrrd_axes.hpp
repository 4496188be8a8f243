#pragma once
// The axes of an NRRD file: which of them are spatial, and their sizes, spacing, unit and
// orientation.

#include <cstddef>
#include <optional>
#include <string>

#include "scene/nrrd_header.hpp"
#include "scene/raw_voxels.hpp"
#include "scene/volume.hpp"

namespace triptych::scene::nrrd {

// The index of the axis that is not spatial and holds the components, if there are four axes.
// Fields with one word per axis have a word for this axis, too.
using LeftOut = std::optional<std::size_t>;

// Sets the sizes and, for four axes, the layout of the components. Throws InputError with file and
// line, as all functions here do.
[[nodiscard]] LeftOut parse_axes(const Header& header, Volume& volume, ValueLayout& layout);

// Sets the spacing and the orientation.
void parse_spacing(const Header& header, const LeftOut& left_out, Volume& volume);

// The first unit of the axes; empty if there is none.
[[nodiscard]] std::string unit_of(const Header& header);

}  // namespace triptych::scene::nrrd
