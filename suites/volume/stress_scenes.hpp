#pragma once
// Functions that create the scenes of stress_cases.hpp. Each function creates all variants of its
// case; `variant` must be listed in the catalogue. Only the catalogue calls these functions.

#include <string_view>

#include "suites/volume/stress_cases.hpp"

namespace triptych::volume_suite {

// Positions of the eye and directions of rays.
[[nodiscard]] StressScene stress_inside(std::string_view variant);
[[nodiscard]] StressScene stress_boundary(std::string_view variant);
[[nodiscard]] StressScene stress_parallel(std::string_view variant);
[[nodiscard]] StressScene stress_within_face(std::string_view variant);
[[nodiscard]] StressScene stress_chord(std::string_view variant);
[[nodiscard]] StressScene stress_octant(std::string_view variant);
[[nodiscard]] StressScene stress_far(std::string_view variant);
[[nodiscard]] StressScene stress_unseen(std::string_view variant);

// Sizes of volumes.
[[nodiscard]] StressScene stress_scale(std::string_view variant);
[[nodiscard]] StressScene stress_spacing(std::string_view variant);
[[nodiscard]] StressScene stress_slice(std::string_view variant);
[[nodiscard]] StressScene stress_tiny(std::string_view variant);
[[nodiscard]] StressScene stress_prime(std::string_view variant);
[[nodiscard]] StressScene stress_oversize(std::string_view variant);

// Contents of voxels.
[[nodiscard]] StressScene stress_format(std::string_view variant);
[[nodiscard]] StressScene stress_nan(std::string_view variant);
[[nodiscard]] StressScene stress_infinite(std::string_view variant);
[[nodiscard]] StressScene stress_denormal(std::string_view variant);
[[nodiscard]] StressScene stress_halves(std::string_view variant);
[[nodiscard]] StressScene stress_flat(std::string_view variant);
[[nodiscard]] StressScene stress_lit(std::string_view variant);
[[nodiscard]] StressScene stress_lit_everywhere(std::string_view variant);

// Transfer functions and steps.
[[nodiscard]] StressScene stress_solid(std::string_view variant);
[[nodiscard]] StressScene stress_nearly_solid(std::string_view variant);
[[nodiscard]] StressScene stress_faint(std::string_view variant);
[[nodiscard]] StressScene stress_march(std::string_view variant);
[[nodiscard]] StressScene stress_stride(std::string_view variant);
[[nodiscard]] StressScene stress_spike(std::string_view variant);
[[nodiscard]] StressScene stress_end_spike(std::string_view variant);
[[nodiscard]] StressScene stress_slope(std::string_view variant);
[[nodiscard]] StressScene stress_edit(std::string_view variant);
[[nodiscard]] StressScene stress_transparent(std::string_view variant);
[[nodiscard]] StressScene stress_opaque(std::string_view variant);

// Properties of the frame.
[[nodiscard]] StressScene stress_shape(std::string_view variant);
[[nodiscard]] StressScene stress_widest(std::string_view variant);
[[nodiscard]] StressScene stress_field_of_view(std::string_view variant);
[[nodiscard]] StressScene stress_asymmetric(std::string_view variant);

}  // namespace triptych::volume_suite
