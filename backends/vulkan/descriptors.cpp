#include "backends/vulkan/descriptors.hpp"

#include <fmt/format.h>

#include <array>
#include <vulkan/vulkan_format_traits.hpp>

#include "core/error.hpp"

namespace triptych::vulkan_backend {

Layout make_layout(const Gpu& gpu, vk::ArrayProxy<const vk::DescriptorSetLayoutBinding> bindings,
                   std::uint32_t push_bytes, vk::ShaderStageFlags push_stages) {
  vk::raii::DescriptorSetLayout set(
      gpu.device, vk::DescriptorSetLayoutCreateInfo{.bindingCount = bindings.size(),
                                                    .pBindings = bindings.data()});
  const vk::PushConstantRange push{.stageFlags = push_stages, .size = push_bytes};
  vk::raii::PipelineLayout pipeline(
      gpu.device, vk::PipelineLayoutCreateInfo{.setLayoutCount = 1,
                                               .pSetLayouts = &*set,
                                               .pushConstantRangeCount = push_bytes > 0 ? 1U : 0U,
                                               .pPushConstantRanges = &push});
  std::string definition = fmt::format("push {} in {}", push_bytes, vk::to_string(push_stages));
  for (const vk::DescriptorSetLayoutBinding& each : bindings) {
    definition += fmt::format(", {}: {} {} in {}", each.binding, each.descriptorCount,
                              vk::to_string(each.descriptorType), vk::to_string(each.stageFlags));
  }
  return {std::move(set), std::move(pipeline), std::move(definition)};
}

vk::raii::DescriptorPool make_pool(const Gpu& gpu, std::uint32_t sets,
                                   std::uint32_t storage_buffers, std::uint32_t texel_buffers,
                                   std::uint32_t structures) {
  const std::array<vk::DescriptorPoolSize, 6> sizes{{
      {.type = vk::DescriptorType::eUniformBuffer, .descriptorCount = 2 * sets},
      {.type = vk::DescriptorType::eCombinedImageSampler, .descriptorCount = 2 * sets},
      {.type = vk::DescriptorType::eStorageBuffer, .descriptorCount = storage_buffers * sets},
      {.type = vk::DescriptorType::eStorageImage, .descriptorCount = sets},
      {.type = vk::DescriptorType::eUniformTexelBuffer, .descriptorCount = texel_buffers * sets},
      {.type = vk::DescriptorType::eAccelerationStructureKHR, .descriptorCount = structures * sets},
  }};
  // Vulkan does not allow pool sizes of 0. Layouts with acceleration structures always have texel
  // buffers as well.
  const std::uint32_t kinds = structures > 0 ? 6 : (texel_buffers > 0 ? 5 : 3);
  return {gpu.device, vk::DescriptorPoolCreateInfo{
                          .maxSets = sets, .poolSizeCount = kinds, .pPoolSizes = sizes.data()}};
}

std::vector<vk::DescriptorSet> allocate_sets(const Gpu& gpu, const vk::raii::DescriptorPool& pool,
                                             const Layout& layout, std::uint32_t count) {
  const std::vector<vk::DescriptorSetLayout> layouts(count, *layout.set);
  return (*gpu.device)
      .allocateDescriptorSets(
          vk::DescriptorSetAllocateInfo{
              .descriptorPool = *pool, .descriptorSetCount = count, .pSetLayouts = layouts.data()},
          *gpu.device.getDispatcher());
}

void bind_buffer(const Gpu& gpu, vk::DescriptorSet set, std::uint32_t binding,
                 vk::DescriptorType type, const Buffer& buffer) {
  const std::uint32_t most = gpu.properties.limits.maxStorageBufferRange;
  if (type == vk::DescriptorType::eStorageBuffer && buffer.size() > most) {
    throw core::NotSupported(
        fmt::format("needs a storage buffer of {} bytes, but maxStorageBufferRange is {}",
                    buffer.size(), most));
  }
  if (!gpu.executes) return;
  const vk::DescriptorBufferInfo info{.buffer = buffer.get(), .range = buffer.size()};
  gpu.device.updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = set,
                                                         .dstBinding = binding,
                                                         .descriptorCount = 1,
                                                         .descriptorType = type,
                                                         .pBufferInfo = &info},
                                  {});
}

vk::raii::BufferView texel_view(const Gpu& gpu, const Buffer& buffer, vk::Format format) {
  const vk::DeviceSize texels = buffer.size() / vk::blockSize(format);
  const vk::DeviceSize most = gpu.properties.limits.maxTexelBufferElements;
  if (texels > most) {
    throw core::NotSupported(fmt::format(
        "needs a texel buffer of {} texels, but maxTexelBufferElements is {}", texels, most));
  }
  if (!gpu.executes) return nullptr;
  return {gpu.device, vk::BufferViewCreateInfo{
                          .buffer = buffer.get(), .format = format, .range = VK_WHOLE_SIZE}};
}

void bind_texels(const Gpu& gpu, vk::DescriptorSet set, std::uint32_t binding,
                 const vk::raii::BufferView& view) {
  if (!gpu.executes) return;
  const vk::BufferView texels = *view;
  gpu.device.updateDescriptorSets(
      vk::WriteDescriptorSet{.dstSet = set,
                             .dstBinding = binding,
                             .descriptorCount = 1,
                             .descriptorType = vk::DescriptorType::eUniformTexelBuffer,
                             .pTexelBufferView = &texels},
      {});
}

void bind_storage_image(const Gpu& gpu, vk::DescriptorSet set, std::uint32_t binding,
                        const Image& image) {
  if (!gpu.executes) return;
  const vk::DescriptorImageInfo info{.imageView = image.view(),
                                     .imageLayout = vk::ImageLayout::eGeneral};
  gpu.device.updateDescriptorSets(
      vk::WriteDescriptorSet{.dstSet = set,
                             .dstBinding = binding,
                             .descriptorCount = 1,
                             .descriptorType = vk::DescriptorType::eStorageImage,
                             .pImageInfo = &info},
      {});
}

void bind_texture(const Gpu& gpu, vk::DescriptorSet set, std::uint32_t binding, const Image& image,
                  const vk::raii::Sampler& sampler) {
  if (!gpu.executes) return;
  const vk::DescriptorImageInfo info{.sampler = *sampler,
                                     .imageView = image.view(),
                                     .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal};
  gpu.device.updateDescriptorSets(
      vk::WriteDescriptorSet{.dstSet = set,
                             .dstBinding = binding,
                             .descriptorCount = 1,
                             .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                             .pImageInfo = &info},
      {});
}

vk::raii::Sampler make_sampler(const Gpu& gpu, vk::Filter filter) {
  constexpr auto edge = vk::SamplerAddressMode::eClampToEdge;
  return {gpu.device, vk::SamplerCreateInfo{.magFilter = filter,
                                            .minFilter = filter,
                                            .addressModeU = edge,
                                            .addressModeV = edge,
                                            .addressModeW = edge}};
}

}  // namespace triptych::vulkan_backend
