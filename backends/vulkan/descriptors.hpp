#pragma once
// Descriptors, which connect resources with the bindings of shaders. Every pipeline uses one set.

#include <string>
#include <vector>

#include "backends/vulkan/memory.hpp"

namespace triptych::vulkan_backend {

struct Layout {
  vk::raii::DescriptorSetLayout set;
  vk::raii::PipelineLayout pipeline;
  std::string definition;  // equal for layouts that are defined in the same way
};
// `push_bytes` is the size of the push constant block of these stages.
[[nodiscard]] Layout make_layout(
    const Gpu& gpu, vk::ArrayProxy<const vk::DescriptorSetLayoutBinding> bindings,
    std::uint32_t push_bytes = 0,
    vk::ShaderStageFlags push_stages = vk::ShaderStageFlagBits::eCompute);

// Creates a pool for this many sets. Each set has up to two uniform buffers, two textures, one
// storage image, and the given numbers of storage buffers, texel buffers and acceleration
// structures.
[[nodiscard]] vk::raii::DescriptorPool make_pool(const Gpu& gpu, std::uint32_t sets,
                                                 std::uint32_t storage_buffers = 3,
                                                 std::uint32_t texel_buffers = 0,
                                                 std::uint32_t structures = 0);
// Allocates sets, which are freed together with the pool.
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
// Binds a view of a buffer that was created for uniform texels.
void bind_texels(const Gpu& gpu, vk::DescriptorSet set, std::uint32_t binding,
                 const vk::raii::BufferView& view);
// The image must be in the layout eGeneral whenever shaders use it.
void bind_storage_image(const Gpu& gpu, vk::DescriptorSet set, std::uint32_t binding,
                        const Image& image);
// The image must be in the layout eShaderReadOnlyOptimal whenever shaders use it.
void bind_texture(const Gpu& gpu, vk::DescriptorSet set, std::uint32_t binding, const Image& image,
                  const vk::raii::Sampler& sampler);

// Creates a sampler with normalised coordinates that are clamped to the edge.
[[nodiscard]] vk::raii::Sampler make_sampler(const Gpu& gpu, vk::Filter filter);

}  // namespace triptych::vulkan_backend
