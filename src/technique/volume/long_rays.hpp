#pragma once
#include <bit>
#include <cstdint>
#include <glm/geometric.hpp>
#include <string_view>

#include "scene/volume_scene.hpp"
#include "technique/volume/preintegration.hpp"

namespace triptych::technique {

// A ray crosses as many planes of voxels as all axes have, at most. It makes a pass for each cell
// and for each piece of one: its parts, and one more for a kink or an extremum. Half of all is left
// to cells with more of them. `more`: passes of loops within a piece.
inline constexpr std::int64_t most_cell_passes = 32'768;
[[nodiscard]] inline std::int64_t cell_passes(const scene::VolumeScene& scene, int more) {
  const auto [nx, ny, nz] = scene.grid->size;
  return (std::int64_t{nx} + ny + nz) * (1 + std::int64_t{scene.parts_of_cell() + 1} * (1 + more));
}

// Samples that a ray takes at most.
[[nodiscard]] inline double most_samples(const scene::VolumeScene& scene) {
  const scene::Box box = scene.box();
  return glm::length(box.hi - box.lo) / scene.step_world();
}

// Whether rays may take so many samples that a pass of the raycaster's loop has to take several
// (TRI_LONG_RAYS of raycast.glsl): Mesa 22.3's llvmpipe and lavapipe let an invocation make 65,535
// passes through all its loops together and then end them in silence. A sample makes one, and where
// it is shaded one for each squaring of the highlight, and a step that may be too deep for one
// look-up one to find its chunk; half of all is left to the loops over bricks. Not always, for
// sixteen copies of a sample's code are slow to compile.
// Of quadrature cells it is the highlight alone whose loop is written out (raycast_reason).
[[nodiscard]] inline bool has_long_rays(const scene::VolumeScene& scene) {
  const int squarings = std::countr_zero(static_cast<unsigned>(scene.shading.exponent));
  if (scene.quadrature == scene::Quadrature::cells) {
    return scene.shading.enabled && cell_passes(scene, 2 * squarings) > most_cell_passes;
  }
  constexpr double most_passes = 32'768;
  const double loops = (scene.shading.enabled ? 1 + squarings : 1) +  //
                       (preintegration_form(scene) == 2 ? 1 : 0);
  return most_samples(scene) * loops > most_passes;
}

// Why such rays cannot be drawn by shaders in parts of a volume, whose loop takes a sample a pass.
inline constexpr std::string_view long_rays_in_parts =
    "in parts of a volume a ray may take only so many samples as some drivers let a loop make "
    "passes: take a longer step";

}  // namespace triptych::technique
