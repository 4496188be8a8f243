#pragma once
#include <bit>
#include <glm/geometric.hpp>
#include <string_view>

#include "scene/volume_scene.hpp"
#include "technique/volume/preintegration.hpp"

namespace triptych::technique {

// Whether rays may take so many samples that a pass of the raycaster's loop has to take several
// (TRI_LONG_RAYS of raycast.glsl): Mesa 22.3's llvmpipe and lavapipe let an invocation make 65,535
// passes through all its loops together and then end them in silence. A sample makes one, and where
// it is shaded one for each squaring of the highlight, and a step that may be too deep for one
// look-up one to find its chunk; half of all is left to the loops over bricks. Not always, for
// sixteen copies of a sample's code are slow to compile.
// Quadrature cells makes few passes wherever it is drawn (raycast_reason).
[[nodiscard]] inline bool has_long_rays(const scene::VolumeScene& scene) {
  if (scene.quadrature == scene::Quadrature::cells) return false;
  constexpr double most_passes = 32'768;
  const scene::Box box = scene.box();
  const double steps = glm::length(box.hi - box.lo) / scene.step_world();
  const int squarings = std::countr_zero(static_cast<unsigned>(scene.shading.exponent));
  const double loops = (scene.shading.enabled ? 1 + squarings : 1) +  //
                       (preintegration_form(scene) == 2 ? 1 : 0);
  return steps * loops > most_passes;
}

// Why such rays cannot be drawn by shaders in parts of a volume, whose loop takes a sample a pass.
inline constexpr std::string_view long_rays_in_parts =
    "in parts of a volume a ray may take only so many samples as some drivers let a loop make "
    "passes: take a longer step";

}  // namespace triptych::technique
