#pragma once
// Functions that create the scenes of stress_cases.hpp. Each function creates all variants of its
// case; `variant` must be listed in the catalogue.

#include <string_view>

#include "suites/particles/stress_cases.hpp"

namespace triptych::particles_suite {

using MakeStressScene = StressScene (*)(std::string_view variant, scene::ColourKind colour);

// Geometry of one or a few spheres.
[[nodiscard]] StressScene stress_scale(std::string_view, scene::ColourKind);
[[nodiscard]] StressScene stress_far(std::string_view, scene::ColourKind);
[[nodiscard]] StressScene stress_giant(std::string_view, scene::ColourKind);
[[nodiscard]] StressScene stress_inside(std::string_view, scene::ColourKind);
[[nodiscard]] StressScene stress_skimming(std::string_view, scene::ColourKind);
[[nodiscard]] StressScene stress_near_plane(std::string_view, scene::ColourKind);
[[nodiscard]] StressScene stress_behind(std::string_view, scene::ColourKind);
[[nodiscard]] StressScene stress_wide(std::string_view, scene::ColourKind);
[[nodiscard]] StressScene stress_edges(std::string_view, scene::ColourKind);
[[nodiscard]] StressScene stress_subpixel(std::string_view, scene::ColourKind);
[[nodiscard]] StressScene stress_depth_range(std::string_view, scene::ColourKind);

// Particle sets: validity, number and order of the particles, and camera movement.
[[nodiscard]] StressScene stress_no_sphere(std::string_view, scene::ColourKind);
[[nodiscard]] StressScene stress_coincident(std::string_view, scene::ColourKind);
[[nodiscard]] StressScene stress_interpenetrating(std::string_view, scene::ColourKind);
[[nodiscard]] StressScene stress_pile(std::string_view, scene::ColourKind);
[[nodiscard]] StressScene stress_count(std::string_view, scene::ColourKind);
[[nodiscard]] StressScene stress_order(std::string_view, scene::ColourKind);
[[nodiscard]] StressScene stress_jump(std::string_view, scene::ColourKind);
[[nodiscard]] StressScene stress_shape(std::string_view, scene::ColourKind);
[[nodiscard]] StressScene stress_widest(std::string_view, scene::ColourKind);
[[nodiscard]] StressScene stress_field_of_view(std::string_view, scene::ColourKind);
[[nodiscard]] StressScene stress_asymmetric(std::string_view, scene::ColourKind);

}  // namespace triptych::particles_suite
