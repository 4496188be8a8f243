#pragma once
// Descriptors, which connect resources to the bindings of device code. Every pipeline has one set.

#include <string>
#include <vector>

#include "backends/vulkan/memory.hpp"

namespace triptych::vulkan_backend {

struct Layout {
  vk::raii::DescriptorSetLayout set;
  vk::raii::PipelineLayout pipeline;
  std::string definition;  // the same text for layouts that are defined in the same way
};
// `push_bytes`: the size of a push constant block for these stages.
[[nodiscard]] Layout make_layout(const Gpu& gpu,
                                 vk::ArrayProxy<const vk::DescriptorSetLayoutBinding> bindings,
                                 std::uint32_t push_bytes = 0,
                                 vk::ShaderStageFlags push_stages =
                                     vk::ShaderStageFlagBits::eCompute);

// Space for this many sets. Each set has up to two uniform buffers, two textures,
// `storage_buffers`, a storage image, `texel_buffers` and `structures`.
[[nodiscard]] vk::raii::DescriptorPool make_pool(const Gpu& gpu, std::uint32_t sets,
                                                 std::uint32_t storage_buffers = 3,
                                                 std::uint32_t texel_buffers = 0,
                                                 std::uint32_t structures = 0);
// The sets are freed with the pool.
[[nodiscard]] std::vector<vk::DescriptorSet> allocate_sets(const Gpu& gpu,
                                                           const vk::raii::DescriptorPool& pool,
                                                           const Layout& layout,
                                                           std::uint32_t count);

// Binds the whole buffer. Throws core::NotSupported if it exceeds maxStorageBufferRange.
void bind_buffer(const Gpu& gpu, vk::DescriptorSet set, std::uint32_t binding,
                 vk::DescriptorType type, const Buffer& buffer);
// Binds the whole buffer as texels. Throws core::NotSupported if it exceeds maxTexelBufferElements.
[[nodiscard]] vk::raii::BufferView texel_view(const Gpu& gpu, const Buffer& buffer,
                                              vk::Format format);
// A view of a buffer that was made for uniform texels.
void bind_texels(const Gpu& gpu, vk::DescriptorSet set, std::uint32_t binding,
                 const vk::raii::BufferView& view);
// The image must be in eGeneral when it is used.
void bind_storage_image(const Gpu& gpu, vk::DescriptorSet set, std::uint32_t binding,
                        const Image& image);
// The image must be in eShaderReadOnlyOptimal when it is used.
void bind_texture(const Gpu& gpu, vk::DescriptorSet set, std::uint32_t binding, const Image& image,
                  const vk::raii::Sampler& sampler);

// Texture coordinates are normalised and clamped to the edge.
[[nodiscard]] vk::raii::Sampler make_sampler(const Gpu& gpu, vk::Filter filter);

}  // namespace triptych::vulkan_backend
