#pragma once
// One file per technique, of its name.

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

[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_quad_screen(
    const Gpu& gpu, const Instance& instance, const measure::ParticleWork& work);
[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_quad_ray(
    const Gpu& gpu, const Instance& instance, const measure::ParticleWork& work);
[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_quad_instanced(
    const Gpu& gpu, const Instance& instance, const measure::ParticleWork& work);
[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_quad_tess(
    const Gpu& gpu, const Instance& instance, const measure::ParticleWork& work);
[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_polygon_tess(
    const Gpu& gpu, const Instance& instance, const measure::ParticleWork& work);
[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_polygon_adaptive(
    const Gpu& gpu, const Instance& instance, const measure::ParticleWork& work);
[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_point(const Gpu& gpu,
                                                               const Instance& instance,
                                                               const measure::ParticleWork& work);
[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_tiles(const Gpu& gpu,
                                                               const Instance& instance,
                                                               const measure::ParticleWork& work);

}  // namespace triptych::vulkan_backend
