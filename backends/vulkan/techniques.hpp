#pragma once
// One file per technique: raycast.cpp, raycast_fragment.cpp, speed_of_light.cpp.

#include <memory>

#include "backends/vulkan/gpu.hpp"
#include "backends/vulkan/instance.hpp"
#include "measure/backend.hpp"

namespace triptych::vulkan_backend {

[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_raycast(const Gpu& gpu,
                                                                 const Instance& instance,
                                                                 const measure::VolumeWork& work);
[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_raycast_fragment(
    const Gpu& gpu, const Instance& instance, const measure::VolumeWork& work);
[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_speed_of_light(
    const Gpu& gpu, const Instance& instance, const measure::VolumeWork& work);

}  // namespace triptych::vulkan_backend
