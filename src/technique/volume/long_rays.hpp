#pragma once
#include <bit>
#include <cstdint>
#include <glm/geometric.hpp>
#include <string_view>

#include "scene/volume_scene.hpp"
#include "technique/volume/preintegration.hpp"

namespace triptych::technique {

// cell_passes() estimates the number of loop iterations that a ray needs with quadrature=cells. It
// must not exceed most_cell_passes. A ray crosses at most as many cells as there are voxel planes
// along all three axes together. It needs one iteration for each cell and 1 + `more` iterations for
// each piece of a cell, where `more` is the number of loop iterations within a piece. A cell
// consists of scene.parts_of_cell() pieces, and of one more piece for each kink of the transfer
// function and for each extremum of the values along the ray. The estimate contains only one such
// additional piece per cell. Because there may be more, most_cell_passes is only half the number of
// iterations that drivers allow.
inline constexpr std::int64_t most_cell_passes = 32'768;
[[nodiscard]] inline std::int64_t cell_passes(const scene::VolumeScene& scene, int more) {
  const auto [nx, ny, nz] = scene.grid->size;
  return (std::int64_t{nx} + ny + nz) * (1 + std::int64_t{scene.parts_of_cell() + 1} * (1 + more));
}

// Returns the maximum number of samples along a ray.
[[nodiscard]] inline double most_samples(const scene::VolumeScene& scene) {
  const scene::Box box = scene.box();
  return glm::length(box.hi - box.lo) / scene.step_world();
}

// Returns whether rays may take so many samples that each iteration of the raycaster's loop must
// take several of them (TRI_LONG_RAYS in raycast.glsl). The reason is that llvmpipe and lavapipe in
// Mesa 22.3 limit each invocation to 65,535 iterations across all its loops, and then end the loops
// without an error. A sample needs one iteration and, with shading, one more for each squaring of
// the highlight. With quadrature=preintegrated, a step whose optical depth may be too large for one
// look-up is processed in chunks, and needs another iteration to find the end of a chunk. Half of
// the allowed iterations are reserved for the loops over bricks. The code for long rays is used
// only if necessary, because it contains sixteen copies of a sample's code and compiles slowly.
// With quadrature=cells, only the loop of the highlight is unrolled (raycast_reason).
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

// The error message for a volume that has such long rays but would have to be drawn in parts. This
// combination is rejected because the loop that draws parts takes only one sample per iteration.
inline constexpr std::string_view long_rays_in_parts =
    "drawing this volume in parts would need one loop iteration per sample, which is more "
    "iterations than some drivers allow; use a longer step";

}  // namespace triptych::technique
