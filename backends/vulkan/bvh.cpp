// Traces rays through a hierarchy of bounding boxes. Compute passes build and traverse it
// (technique/particles/hierarchy.glsl, bvh.comp.glsl).
#include "backends/vulkan/hierarchy_tracer.hpp"
#include "backends/vulkan/techniques.hpp"
#include "backends/vulkan/traced_frames.hpp"

namespace triptych::vulkan_backend {

std::unique_ptr<measure::Prepared> prepare_bvh(const Gpu& gpu, const Instance& instance,
                                               const measure::ParticleWork& work) {
  return prepare_traced(gpu, instance, work, &make_hierarchy_tracer);
}

}  // namespace triptych::vulkan_backend
