#pragma once
// The techniques of the catalogue for this API. Each is implemented in the file that has its name.
// All functions are called while the context is current.

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
  // The requirements of this technique in addition to volume_unsupported().
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
