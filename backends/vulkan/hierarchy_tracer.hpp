#pragma once
// The hierarchy of technique/particles/hierarchy.glsl. Several compute passes build it, and one
// pass traverses it.

#include <memory>

#include "backends/vulkan/traced_frames.hpp"
#include "technique/particles/hierarchy.hpp"

namespace triptych::vulkan_backend {

[[nodiscard]] std::unique_ptr<Tracer> make_hierarchy_tracer(
    const Gpu& gpu, const measure::ParticleWork& work, const technique::Arrangement& arrangement,
    const ParticleData& data);

}  // namespace triptych::vulkan_backend
