#pragma once
// Techniques that draw spheres as sprites. They differ only in the stages before the fragment
// stage.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "backends/gl/particle_source.hpp"
#include "backends/gl/prepared.hpp"
#include "backends/gl/techniques.hpp"

namespace triptych::gl_backend {

// A way to turn particles into sprites.
struct SpriteDraw {
  GLenum mode = GL_POINTS;
  // True: a particle is an instance of four vertices; false: a particle is one vertex.
  bool instanced = false;
  bool large_only = false;  // for cells that may contain spheres larger than the largest point
  std::vector<ParticleStage> stages;  // the stages before the fragment stage
};
using Sprites = std::vector<SpriteDraw>;

// Stages that several techniques use.
[[nodiscard]] ParticleStage attribute_stage();
// A vertex stage that finds its particle by the number of the instance.
[[nodiscard]] ParticleStage instance_stage(const Api& gl, std::string_view file);
// One patch for each particle, one quad for each particle.
[[nodiscard]] Sprites tessellated(std::string_view define);
[[nodiscard]] Sprites from_geometry_stage(bool screen_aligned);

// The reason why these stages cannot draw the work on this device; empty if they can.
[[nodiscard]] std::optional<std::string> sprites_unsupported(const Api& gl,
                                                             const measure::ParticleWork& work,
                                                             const Sprites& sprites);
[[nodiscard]] std::unique_ptr<Drawing> draw_sprites(const Api& gl,
                                                    const measure::ParticleWork& work,
                                                    const Sprites& sprites);

// A technique whose sprites depend only on the context.
template <Sprites (*describe)(const Api& gl)>
[[nodiscard]] ParticleTechnique sprite_technique() {
  return {[](const Api& gl, const measure::ParticleWork& work) {
            return sprites_unsupported(gl, work, describe(gl));
          },
          [](const Api& gl, const measure::ParticleWork& work) {
            return draw_sprites(gl, work, describe(gl));
          }};
}

}  // namespace triptych::gl_backend
