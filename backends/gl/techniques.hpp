#pragma once
// The catalogue's techniques for OpenGL. Each technique is implemented in the file of the same
// name. All functions must be called while the context is current.

#include <memory>
#include <optional>
#include <string>

#include "backends/gl/context.hpp"
#include "backends/gl/prepared.hpp"
#include "backends/gl/timing.hpp"
#include "measure/contract/backend.hpp"
#include "technique_list.hpp"

namespace triptych::gl_backend {

struct VolumeTechnique {
  // Returns why this technique cannot draw the work, in addition to the reasons of
  // volume_unsupported().
  std::optional<std::string> (*unsupported)(const Api& gl, const measure::VolumeWork& work);
  std::unique_ptr<measure::Prepared> (*prepare)(Context& context, Stamps stamps,
                                                const measure::VolumeWork& work);
};

struct ParticleTechnique {
  std::optional<std::string> (*unsupported)(const Api& gl, const measure::ParticleWork& work);
  std::unique_ptr<Drawing> (*make)(const Api& gl, const measure::ParticleWork& work);
};

#define DECLARE(id, needs) [[nodiscard]] VolumeTechnique id();
TRIPTYCH_VOLUME_TECHNIQUES(DECLARE)
#undef DECLARE
#define DECLARE(id, needs) [[nodiscard]] ParticleTechnique id();
TRIPTYCH_PARTICLE_TECHNIQUES(DECLARE)
#undef DECLARE

}  // namespace triptych::gl_backend
