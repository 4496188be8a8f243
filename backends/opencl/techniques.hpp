#pragma once
// One file per technique: raycast.cpp, speed_of_light.cpp.

#include <memory>

#include "backends/opencl/objects.hpp"
#include "backends/opencl/programs.hpp"
#include "backends/opencl/volume_data.hpp"
#include "measure/backend.hpp"

namespace triptych::opencl_backend {

[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_raycast(const Session& session,
                                                                 Programs& programs,
                                                                 VolumeCache& volumes,
                                                                 const measure::VolumeWork& work);
[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_speed_of_light(
    const Session& session, Programs& programs, VolumeCache& volumes,
    const measure::VolumeWork& work);

}  // namespace triptych::opencl_backend
