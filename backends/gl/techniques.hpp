#pragma once
// The techniques that the catalogue has for this API; each is implemented in the file of its name.
// All functions are called with the context current.

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
  // Beyond volume_unsupported(): what this technique alone needs.
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
