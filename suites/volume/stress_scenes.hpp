#pragma once
// How the scenes of stress_cases.hpp are made. Each function makes every variant of its case;
// `variant` is one that the catalogue lists. Used by the catalogue alone.

#include <string_view>

#include "suites/volume/stress_cases.hpp"

namespace triptych::volume_suite {

// Where the eye is and where rays go.
[[nodiscard]] StressScene stress_inside(std::string_view variant);
[[nodiscard]] StressScene stress_boundary(std::string_view variant);
[[nodiscard]] StressScene stress_parallel(std::string_view variant);
[[nodiscard]] StressScene stress_within_face(std::string_view variant);
[[nodiscard]] StressScene stress_chord(std::string_view variant);
[[nodiscard]] StressScene stress_octant(std::string_view variant);
[[nodiscard]] StressScene stress_far(std::string_view variant);
[[nodiscard]] StressScene stress_unseen(std::string_view variant);

// How large things are.
[[nodiscard]] StressScene stress_scale(std::string_view variant);
[[nodiscard]] StressScene stress_spacing(std::string_view variant);
[[nodiscard]] StressScene stress_slice(std::string_view variant);
[[nodiscard]] StressScene stress_tiny(std::string_view variant);
[[nodiscard]] StressScene stress_prime(std::string_view variant);
[[nodiscard]] StressScene stress_oversize(std::string_view variant);

// What voxels may hold.
[[nodiscard]] StressScene stress_format(std::string_view variant);
[[nodiscard]] StressScene stress_nan(std::string_view variant);
[[nodiscard]] StressScene stress_infinite(std::string_view variant);
[[nodiscard]] StressScene stress_denormal(std::string_view variant);
[[nodiscard]] StressScene stress_halves(std::string_view variant);
[[nodiscard]] StressScene stress_flat(std::string_view variant);
[[nodiscard]] StressScene stress_lit(std::string_view variant);
[[nodiscard]] StressScene stress_lit_everywhere(std::string_view variant);

// What transfer functions and steps may do.
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

// What is special about the frame.
[[nodiscard]] StressScene stress_shape(std::string_view variant);
[[nodiscard]] StressScene stress_widest(std::string_view variant);
[[nodiscard]] StressScene stress_field_of_view(std::string_view variant);
[[nodiscard]] StressScene stress_asymmetric(std::string_view variant);

}  // namespace triptych::volume_suite
