#pragma once
// The part that ray_query and ray_pipeline share: the acceleration structure and its bindings.

#include <memory>

#include "backends/vulkan/sphere_structure.hpp"
#include "backends/vulkan/traced_frames.hpp"

namespace triptych::vulkan_backend {

class StructureTracer : public Tracer {
 public:
  StructureTracer(const Gpu& gpu, const measure::ParticleWork& work, const ParticleData& data);

  [[nodiscard]] std::vector<vk::DescriptorSetLayoutBinding> bindings() const final;
  [[nodiscard]] std::uint32_t push_bytes() const final { return sizeof(std::int32_t); }
  [[nodiscard]] bool counts_nodes() const final { return false; }
  void bind(vk::DescriptorSet set) const final;
  void prepare(const Layout& layout, vk::DescriptorSet set) final;
  void record(const vk::raii::CommandBuffer& commands, const Layout& layout,
              bool counting) const final;

 protected:
  // Creates the pipelines that trace rays.
  virtual void prepare_rays(const Layout& layout) = 0;
  // Traces a ray for each pixel of every `every_row`-th row.
  virtual void trace_rays(const vk::raii::CommandBuffer& commands, const Layout& layout,
                          bool counting, std::uint32_t every_row) const = 0;

  const Gpu& gpu_;
  technique::ParticleOptions options_;
  Specialization constants_;
  std::uint32_t width_;
  std::uint32_t height_;

 private:
  SphereStructure structure_;
  vk::raii::BufferView spheres_;
};

}  // namespace triptych::vulkan_backend
