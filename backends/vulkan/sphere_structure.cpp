#include "backends/vulkan/sphere_structure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "core/error.hpp"
#include "technique/particles/hierarchy.hpp"

namespace triptych::vulkan_backend {
namespace {

using enum vk::BufferUsageFlagBits;
using technique::Structure;
using Type = vk::AccelerationStructureTypeKHR;

constexpr std::string_view boxes_code = "ray_boxes.comp.spv";
constexpr vk::DeviceSize box_bytes = sizeof(vk::AabbPositionsKHR);

// A structure that is built once, or refitted, is optimized for fast tracing. A structure that is
// built in every frame is optimized for fast building.
vk::BuildAccelerationStructureFlagsKHR flags_of(Structure kind) {
  using enum vk::BuildAccelerationStructureFlagBitsKHR;
  switch (kind) {
    case Structure::built_once:
      return ePreferFastTrace;
    case Structure::refitted:
      return ePreferFastTrace | eAllowUpdate;
    case Structure::rebuilt:
      return ePreferFastBuild;
  }
  return ePreferFastTrace;
}

std::uint32_t checked_count(const Gpu& gpu, std::uint32_t particles) {
  if (particles > gpu.extensions.most_boxes) {
    throw core::NotSupported(
        fmt::format("{} particles need one box each in an acceleration structure, "
                    "but maxPrimitiveCount is {}",
                    particles, gpu.extensions.most_boxes));
  }
  return particles;
}

}  // namespace

SphereStructure::SphereStructure(const Gpu& gpu, std::uint32_t particles, Structure kind)
    : gpu_(gpu),
      particles_(checked_count(gpu, particles)),
      kind_(kind),
      boxes_(gpu, box_bytes * std::max(particles_, 1U),
             eStorageBuffer | eShaderDeviceAddress | eAccelerationStructureBuildInputReadOnlyKHR,
             Place::device),
      bottom_(make_level(Type::eBottomLevel, boxes(), particles_)),
      instance_(make_instance()),
      top_(make_level(Type::eTopLevel, instances(), 1)) {}

std::string_view SphereStructure::code() {
  return spirv(boxes_code);
}

vk::DeviceAddress SphereStructure::address(const Buffer& buffer) const {
  return gpu_.device.getBufferAddressKHR({.buffer = buffer.get()});
}

vk::AccelerationStructureGeometryKHR SphereStructure::boxes() const {
  vk::AccelerationStructureGeometryKHR geometry{.geometryType = vk::GeometryTypeKHR::eAabbs};
  geometry.geometry.setAabbs({.data = address(boxes_), .stride = box_bytes});
  return geometry;
}

vk::AccelerationStructureGeometryKHR SphereStructure::instances() const {
  vk::AccelerationStructureGeometryKHR geometry{.geometryType = vk::GeometryTypeKHR::eInstances};
  geometry.geometry.setInstances({.arrayOfPointers = VK_FALSE, .data = address(instance_)});
  return geometry;
}

SphereStructure::Level SphereStructure::make_level(
    Type type, const vk::AccelerationStructureGeometryKHR& geometry,
    std::uint32_t primitives) const {
  // RADV of Mesa 25.0 crashes if there is no GPU and the size of a structure is queried. Compiling
  // pipelines needs no structure.
  if (!gpu_.executes) {
    return {Buffer(gpu_, 1, eStorageBuffer, Place::device), nullptr,
            Buffer(gpu_, 1, eStorageBuffer, Place::device)};
  }
  const vk::AccelerationStructureBuildGeometryInfoKHR info{
      .type = type, .flags = flags_of(kind_), .geometryCount = 1, .pGeometries = &geometry};
  const vk::AccelerationStructureBuildSizesInfoKHR sizes =
      gpu_.device.getAccelerationStructureBuildSizesKHR(
          vk::AccelerationStructureBuildTypeKHR::eDevice, info, primitives);
  Buffer memory(gpu_, std::max<vk::DeviceSize>(sizes.accelerationStructureSize, 1),
                eAccelerationStructureStorageKHR | eShaderDeviceAddress, Place::device);
  vk::raii::AccelerationStructureKHR structure(
      gpu_.device, vk::AccelerationStructureCreateInfoKHR{
                       .buffer = memory.get(), .size = memory.size(), .type = type});
  // The address of scratch memory must be aligned, so the buffer is enlarged by the required
  // alignment.
  const vk::DeviceSize alignment = gpu_.extensions.scratch_alignment;
  Buffer scratch(gpu_, std::max(sizes.buildScratchSize, sizes.updateScratchSize) + alignment,
                 eStorageBuffer | eShaderDeviceAddress, Place::device);
  const vk::DeviceAddress at = (address(scratch) + alignment - 1) / alignment * alignment;
  return {std::move(memory), std::move(structure), std::move(scratch), at};
}

Buffer SphereStructure::make_instance() const {
  const vk::DeviceAddress bottom = gpu_.executes
                                       ? gpu_.device.getAccelerationStructureAddressKHR(
                                             {.accelerationStructure = *bottom_.structure})
                                       : 0;
  vk::AccelerationStructureInstanceKHR instance{.mask = 0xFF,
                                                .accelerationStructureReference = bottom};
  for (std::size_t axis = 0; axis < 3; ++axis) instance.transform.matrix.at(axis).at(axis) = 1;
  return make_buffer(gpu_, std::as_bytes(std::span(&instance, 1)),
                     eShaderDeviceAddress | eAccelerationStructureBuildInputReadOnlyKHR);
}

void SphereStructure::bind(vk::DescriptorSet set) const {
  bind_buffer(gpu_, set, boxes_binding, vk::DescriptorType::eStorageBuffer, boxes_);
  if (!gpu_.executes) return;
  const vk::WriteDescriptorSetAccelerationStructureKHR structure{
      .accelerationStructureCount = 1, .pAccelerationStructures = &*top_.structure};
  gpu_.device.updateDescriptorSets(
      vk::WriteDescriptorSet{.pNext = &structure,
                             .dstSet = set,
                             .dstBinding = structure_binding,
                             .descriptorCount = 1,
                             .descriptorType = vk::DescriptorType::eAccelerationStructureKHR},
      {});
}

void SphereStructure::prepare(const Layout& layout, const Specialization& constants) {
  make_boxes_ = compute_pipeline(gpu_, layout, code(), constants);
}

void SphereStructure::record_level(const vk::raii::CommandBuffer& commands, Type type,
                                   const Level& level,
                                   const vk::AccelerationStructureGeometryKHR& geometry,
                                   std::uint32_t primitives, bool refit) const {
  using enum vk::BuildAccelerationStructureModeKHR;
  vk::AccelerationStructureBuildGeometryInfoKHR info{.type = type,
                                                     .flags = flags_of(kind_),
                                                     .mode = refit ? eUpdate : eBuild,
                                                     .dstAccelerationStructure = *level.structure,
                                                     .geometryCount = 1,
                                                     .pGeometries = &geometry};
  if (refit) info.srcAccelerationStructure = *level.structure;
  info.scratchData.deviceAddress = level.scratch_at;
  const vk::AccelerationStructureBuildRangeInfoKHR range{.primitiveCount = primitives};
  commands.buildAccelerationStructuresKHR(info, &range);
  barrier(commands);
}

void SphereStructure::record_build(const vk::raii::CommandBuffer& commands, bool refit) const {
  commands.bindPipeline(vk::PipelineBindPoint::eCompute, make_boxes_);
  const auto [columns, rows] = technique::group_rows(particles_);
  commands.dispatch(columns, rows, 1);
  barrier(commands);
  record_level(commands, Type::eBottomLevel, bottom_, boxes(), particles_, refit);
  record_level(commands, Type::eTopLevel, top_, instances(), 1, refit);
}

}  // namespace triptych::vulkan_backend
