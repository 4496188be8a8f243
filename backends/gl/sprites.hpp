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

// One draw of a frame, with the stages that turn particles into sprites.
struct SpriteDraw {
  GLenum mode = GL_POINTS;
  // Whether a particle is an instance of four vertices (true) or a single vertex (false).
  bool instanced = false;
  // whether to draw only cells (ranges of neighbouring particles) that may contain spheres larger
  // than the largest point
  bool large_only = false;
  std::vector<ParticleStage> stages;  // the stages before the fragment stage
};
using Sprites = std::vector<SpriteDraw>;

// Stages that several techniques use.
[[nodiscard]] ParticleStage attribute_stage();
// Returns a vertex stage that finds its particle by the instance number.
[[nodiscard]] ParticleStage instance_stage(const Api& gl, std::string_view file);
// tessellated() draws one patch per particle.
[[nodiscard]] Sprites tessellated(std::string_view define);
[[nodiscard]] Sprites from_geometry_stage(bool screen_aligned);

// Returns the reason why these stages cannot draw the work on this device; nullopt if they can.
[[nodiscard]] std::optional<std::string> sprites_unsupported(const Api& gl,
                                                             const measure::ParticleWork& work,
                                                             const Sprites& sprites);
[[nodiscard]] std::unique_ptr<Drawing> draw_sprites(const Api& gl,
                                                    const measure::ParticleWork& work,
                                                    const Sprites& sprites);

// Creates a technique whose sprites depend only on the context.
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
