#pragma once
// Each technique of the catalogue is implemented in the file of the same name.

#include <memory>

#include "backends/opencl/objects.hpp"
#include "backends/opencl/programs.hpp"
#include "backends/opencl/volume_data.hpp"
#include "measure/contract/backend.hpp"
#include "technique_list.hpp"

namespace triptych::opencl_backend {

#define DECLARE(id, needs)                                              \
  [[nodiscard]] std::unique_ptr<measure::Prepared> prepare_##id(        \
      const Session& session, Programs& programs, VolumeCache& volumes, \
      const measure::VolumeWork& work);
TRIPTYCH_VOLUME_TECHNIQUES(DECLARE)
#undef DECLARE

#define DECLARE(id, needs)                                       \
  [[nodiscard]] std::unique_ptr<measure::Prepared> prepare_##id( \
      const Session& session, Programs& programs, const measure::ParticleWork& work);
TRIPTYCH_PARTICLE_TECHNIQUES(DECLARE)
#undef DECLARE

}  // namespace triptych::opencl_backend
