#pragma once
// One file per technique, named as in the catalogue.

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

[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_tiles(const Session& session,
                                                               Programs& programs,
                                                               const measure::ParticleWork& work);

[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_quad_screen(
    const Session& session, Programs& programs, const measure::ParticleWork& work);
[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_quad_ray(
    const Session& session, Programs& programs, const measure::ParticleWork& work);
[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_quad_instanced(
    const Session& session, Programs& programs, const measure::ParticleWork& work);
[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_quad_tess(
    const Session& session, Programs& programs, const measure::ParticleWork& work);
[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_polygon_tess(
    const Session& session, Programs& programs, const measure::ParticleWork& work);
[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_polygon_adaptive(
    const Session& session, Programs& programs, const measure::ParticleWork& work);

}  // namespace triptych::opencl_backend
