#pragma once
// The data of particles on the device, in the order of technique::Arrangement.

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
  cl::Buffer colours;     // one or four words per particle, depending on the colour format
  cl::Buffer ids;
  cl::Buffer cells;  // technique::Cell
  cl::Buffer table;  // the table of the transfer function
};

// Uses the camera of this scene for all later frames. Returns when the upload has finished.
void upload_camera(const Session& session, const ParticleData& data,
                   const measure::ParticleWork& work);

// Arranges the particles and uploads them. Returns when the upload has finished.
[[nodiscard]] ParticleData upload(const Session& session, const measure::ParticleWork& work);

}  // namespace triptych::opencl_backend
