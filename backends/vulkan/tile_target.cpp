#include "backends/vulkan/tile_target.hpp"

#include <array>

#include "backends/vulkan/descriptors.hpp"
#include "backends/vulkan/particle_target.hpp"
#include "backends/vulkan/tile_buffers.hpp"

namespace triptych::vulkan_backend {
namespace {

constexpr vk::Format particle_format = vk::Format::eR32Uint;
constexpr vk::Format depth_format = vk::Format::eD32Sfloat;

}  // namespace

TileTarget::TileTarget(const Gpu& gpu, std::uint32_t width, std::uint32_t height)
    : particles_(gpu, vk::ImageType::e2D, particle_format, {width, height, 1},
                 vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eSampled),
      depth_(gpu, vk::ImageType::e2D, depth_format, {width, height, 1},
             vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eSampled,
             vk::ImageAspectFlagBits::eDepth),
      sampler_(make_sampler(gpu, vk::Filter::eNearest)),
      clearing_(depth_pass(gpu, formats(), false, vk::ImageLayout::eShaderReadOnlyOptimal)),
      continuing_(depth_pass(gpu, formats(), true, vk::ImageLayout::eShaderReadOnlyOptimal)),
      framebuffer_(depth_framebuffer(gpu, clearing_, std::array{particles_.view(), depth_.view()},
                                     particles_.extent())) {}

std::vector<vk::Format> TileTarget::formats() {
  return {particle_format, depth_format};
}

void TileTarget::begin(const vk::raii::CommandBuffer& commands, bool continued) const {
  const std::array<vk::ClearValue, 2> clear{
      vk::ClearColorValue(std::array<std::uint32_t, 4>{core::Image::no_particle, 0, 0, 0}),
      vk::ClearDepthStencilValue{.depth = 0}};
  begin_pass(commands, continued ? continuing_ : clearing_, framebuffer_, particles_.extent(),
             clear);
}

void TileTarget::bind(const Gpu& gpu, vk::DescriptorSet set) const {
  bind_texture(gpu, set, large_depth_binding, depth_, sampler_);
  bind_texture(gpu, set, large_particle_binding, particles_, sampler_);
}

}  // namespace triptych::vulkan_backend
