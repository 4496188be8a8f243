#pragma once
// Particles on the device, in the order of the arrangement.

#include <cstddef>
#include <cstdint>

#include "backends/opencl/objects.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::opencl_backend {

struct ParticleData {
  std::size_t count = 0;
  std::size_t cell_count = 0;
  cl::Buffer parameters;  // technique::ParticleParameters
  cl::Buffer spheres;     // float4
  cl::Buffer colours;     // one or four words for each particle, depending on the kind
  cl::Buffer ids;
  cl::Buffer cells;  // technique::Cell
  cl::Buffer table;  // the table of the transfer function
};

// From now on, frames are seen from the camera of this scene. The upload has finished when this
// returns.
void look_from(const Session& session, const ParticleData& data, const measure::ParticleWork& work);

// Arranges the particles and uploads them. The upload has finished when this returns.
[[nodiscard]] ParticleData upload(const Session& session, const measure::ParticleWork& work);

}  // namespace triptych::opencl_backend
