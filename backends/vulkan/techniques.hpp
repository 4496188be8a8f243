#pragma once
// Each technique of the catalogue is implemented in the file of the same name.

#include <memory>

#include "backends/vulkan/gpu.hpp"
#include "backends/vulkan/instance.hpp"
#include "measure/contract/backend.hpp"
#include "technique_list.hpp"

namespace triptych::vulkan_backend {

#define DECLARE_FOR(id, SuiteWork)                               \
  [[nodiscard]] std::unique_ptr<measure::Prepared> prepare_##id( \
      const Gpu& gpu, const Instance& instance, const measure::SuiteWork& work);
#define DECLARE(id, needs) DECLARE_FOR(id, VolumeWork)
TRIPTYCH_VOLUME_TECHNIQUES(DECLARE)
#undef DECLARE
#define DECLARE(id, needs) DECLARE_FOR(id, ParticleWork)
TRIPTYCH_PARTICLE_TECHNIQUES(DECLARE)
#undef DECLARE
#undef DECLARE_FOR

}  // namespace triptych::vulkan_backend
