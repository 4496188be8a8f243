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
  cl::Buffer colours;     // one or four words each, by kind
  cl::Buffer ids;
  cl::Buffer cells;  // technique::Cell
  cl::Buffer table;  // of the transfer function
};

// What is drawn from now on is seen from this scene's camera; done on return.
void look_from(const Session& session, const ParticleData& data, const measure::ParticleWork& work);

// Arranges and uploads; done on return.
[[nodiscard]] ParticleData upload(const Session& session, const measure::ParticleWork& work);

}  // namespace triptych::opencl_backend
