#pragma once
// The techniques of this API; each is implemented in the file of its name. All functions
// are called with the context current.

#include <memory>
#include <optional>
#include <string>

#include "backends/gl/context.hpp"
#include "backends/gl/prepared.hpp"
#include "backends/gl/timing.hpp"
#include "measure/backend.hpp"

namespace triptych::gl_backend {

struct VolumeTechnique {
  // Beyond volume_unsupported(): what this technique alone needs.
  std::optional<std::string> (*unsupported)(const Api& gl, const measure::VolumeWork& work);
  std::unique_ptr<measure::Prepared> (*prepare)(Context& context, Stamps stamps,
                                                const measure::VolumeWork& work);
};

[[nodiscard]] VolumeTechnique raycast();
[[nodiscard]] VolumeTechnique raycast_fragment();
[[nodiscard]] VolumeTechnique speed_of_light();

struct ParticleTechnique {
  std::optional<std::string> (*unsupported)(const Api& gl, const measure::ParticleWork& work);
  std::unique_ptr<Drawing> (*make)(const Api& gl, const measure::ParticleWork& work);
};

[[nodiscard]] ParticleTechnique quad_screen();
[[nodiscard]] ParticleTechnique quad_ray();
[[nodiscard]] ParticleTechnique quad_instanced();
[[nodiscard]] ParticleTechnique quad_tess();
[[nodiscard]] ParticleTechnique polygon_tess();
[[nodiscard]] ParticleTechnique polygon_adaptive();
[[nodiscard]] ParticleTechnique point();
[[nodiscard]] ParticleTechnique tiles();

}  // namespace triptych::gl_backend
