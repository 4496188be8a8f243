#pragma once
// An acceleration structure over the particles. The bottom level has one box per particle, and the
// top level has a single instance of the bottom level.

#include "backends/vulkan/particle_data.hpp"
#include "technique/particles/particle_options.hpp"

namespace triptych::vulkan_backend {

class SphereStructure {
 public:
  // The bindings of ray_boxes.comp.glsl and of the shaders that trace rays.
  static constexpr std::uint32_t boxes_binding = 7;
  static constexpr std::uint32_t structure_binding = 20;

  // Throws core::NotSupported if the device does not support this many boxes.
  SphereStructure(const Gpu& gpu, std::uint32_t particles, technique::Structure kind);

  void bind(vk::DescriptorSet set) const;
  void prepare(const Layout& layout, const Specialization& constants);
  // Rebuilds the boxes and both levels. With `refit`, both levels keep their topology. The
  // descriptor set must be bound.
  void record_build(const vk::raii::CommandBuffer& commands, bool refit) const;

  [[nodiscard]] static std::string_view code();

 private:
  struct Level {
    Buffer memory;
    vk::raii::AccelerationStructureKHR structure;
    Buffer scratch;
    vk::DeviceAddress scratch_at = 0;
  };
  [[nodiscard]] vk::DeviceAddress address(const Buffer& buffer) const;
  [[nodiscard]] vk::AccelerationStructureGeometryKHR boxes() const;
  [[nodiscard]] vk::AccelerationStructureGeometryKHR instances() const;
  [[nodiscard]] Level make_level(vk::AccelerationStructureTypeKHR type,
                                 const vk::AccelerationStructureGeometryKHR& geometry,
                                 std::uint32_t primitives) const;
  [[nodiscard]] Buffer make_instance() const;
  void record_level(const vk::raii::CommandBuffer& commands, vk::AccelerationStructureTypeKHR type,
                    const Level& level, const vk::AccelerationStructureGeometryKHR& geometry,
                    std::uint32_t primitives, bool refit) const;

  const Gpu& gpu_;
  std::uint32_t particles_;
  technique::Structure kind_;
  Buffer boxes_;
  Level bottom_;
  Buffer instance_;
  Level top_;
  vk::Pipeline make_boxes_;
};

}  // namespace triptych::vulkan_backend
