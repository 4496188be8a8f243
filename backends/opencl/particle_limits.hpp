#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "backends/opencl/objects.hpp"
#include "measure/backend.hpp"

namespace triptych::opencl_backend {

// Why the device cannot draw these particles so; empty when it can.
[[nodiscard]] std::optional<std::string> particle_defect(const Session& session,
                                                         std::string_view technique,
                                                         const measure::ParticleWork& work);

}  // namespace triptych::opencl_backend
