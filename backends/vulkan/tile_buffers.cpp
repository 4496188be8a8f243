#include "backends/vulkan/tile_buffers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "core/error.hpp"

namespace triptych::vulkan_backend {
namespace {

constexpr std::uint32_t tile_edge{technique::tile_edge};
constexpr std::uint32_t block_edge = 4;  // in tiles; TRI_BLOCK
constexpr vk::DeviceSize word = sizeof(std::uint32_t);
constexpr vk::DeviceSize tile_bytes = 8 * word;
constexpr vk::DeviceSize header_bytes = 8 * word;
constexpr vk::DeviceSize groups_at = 4 * word;  // the offset of the group counts in the header
constexpr std::uint32_t texel_bindings = id_texels_binding - camera_texels_binding + 1;

std::uint32_t parts(std::uint32_t size, std::uint32_t part) {
  return (size + part - 1) / part;
}

Buffer words(const Gpu& gpu, vk::DeviceSize count) {
  using enum vk::BufferUsageFlagBits;
  return {gpu, word * std::max<vk::DeviceSize>(count, 4),
          eStorageBuffer | eUniformTexelBuffer | eIndirectBuffer | eTransferDst, Place::device};
}

// Returns the size of the image in which each texel stores two pixels, one above the other. It has
// a single texel if no pass before the last one draws large spheres.
vk::Extent3D pairs(const scene::ParticleScene& scene, const technique::TileRounds& rounds) {
  if (!rounds.resolved()) return {1, 1, 1};
  return {static_cast<std::uint32_t>(scene.width),
          parts(static_cast<std::uint32_t>(scene.height), 2), 1};
}

// Returns the factor by which kept_ and entries_ are enlarged. It is 2 with injected extra work,
// because a particle and its entries (pairs of a tile and a sphere) may then be stored twice;
// otherwise it is 1.
std::uint64_t times(const measure::ParticleWork& work) {
  return work.options.extra_work_stride > 0 ? 2 : 1;
}

}  // namespace

std::vector<vk::DescriptorSetLayoutBinding> tile_bindings() {
  using Stage = vk::ShaderStageFlagBits;
  auto all = particle_bindings();
  for (std::uint32_t at = camera_spheres_binding; at <= cell_ends_binding; ++at) {
    all.push_back(storage_binding(at, Stage::eCompute));
  }
  constexpr vk::ShaderStageFlags every = Stage::eVertex | Stage::eFragment | Stage::eCompute;
  for (std::uint32_t at = camera_texels_binding; at <= large_pixels_binding; ++at) {
    const bool image = at == large_pixels_binding;
    all.push_back({.binding = at,
                   .descriptorType = image ? vk::DescriptorType::eStorageImage
                                           : vk::DescriptorType::eUniformTexelBuffer,
                   .descriptorCount = 1,
                   .stageFlags = every});
  }
  return all;
}

vk::raii::DescriptorPool tile_pool(const Gpu& gpu) {
  return make_pool(gpu, 1, cell_ends_binding + 1, texel_bindings);
}

TileBuffers::TileBuffers(const Gpu& gpu, const measure::ParticleWork& work,
                         const ParticleData& data, const technique::TileRounds& rounds)
    : gpu_(gpu),
      columns_(parts(static_cast<std::uint32_t>(work.scene.width), tile_edge)),
      rows_(parts(static_cast<std::uint32_t>(work.scene.height), tile_edge)),
      plane_(word * static_cast<vk::DeviceSize>(work.scene.width) *
             static_cast<vk::DeviceSize>(work.scene.height)),
      small_(rounds.small),
      camera_spheres_(words(gpu, 4 * vk::DeviceSize{data.particles()})),
      kept_(words(gpu, times(work) * data.particles())),
      tiles_(words(gpu, (header_bytes + tile_bytes * columns_ * rows_) / word)),
      entries_(words(gpu, times(work) * rounds.entries)),
      pixels_(words(gpu, 2 * plane_ / word)),
      cell_ends_(words(gpu, data.cells())),
      large_pixels_(gpu, vk::ImageType::e2D, vk::Format::eR32G32B32A32Uint,
                    pairs(work.scene, rounds), vk::ImageUsageFlagBits::eStorage) {
  const auto add = [&](std::uint32_t binding, const Buffer& buffer, vk::Format format) {
    texels_.push_back({binding, texel_view(gpu, buffer, format)});
  };
  add(camera_texels_binding, camera_spheres_, vk::Format::eR32G32B32A32Sfloat);
  add(tile_texels_binding, tiles_, vk::Format::eR32G32B32A32Uint);
  add(entry_texels_binding, entries_, vk::Format::eR32Uint);
  add(pixel_texels_binding, pixels_, vk::Format::eR32Uint);
  add(sphere_texels_binding, data.spheres(), vk::Format::eR32G32B32A32Sfloat);
  add(colour_texels_binding, data.colours(), vk::Format::eR32Uint);
  add(id_texels_binding, data.ids(), vk::Format::eR32Uint);
  run_once(gpu, [&](const vk::raii::CommandBuffer& commands) {
    clear_pixels(commands);
    change_layout(commands, large_pixels_, vk::ImageLayout::eUndefined, vk::ImageLayout::eGeneral);
  });
}

std::uint32_t TileBuffers::blocks() const noexcept {
  return parts(columns_, block_edge) * parts(rows_, block_edge);
}

void TileBuffers::bind(vk::DescriptorSet set) const {
  const auto storage = [&](std::uint32_t binding, const Buffer& buffer) {
    bind_buffer(gpu_, set, binding, vk::DescriptorType::eStorageBuffer, buffer);
  };
  storage(camera_spheres_binding, camera_spheres_);
  storage(kept_binding, kept_);
  storage(tiles_binding, tiles_);
  storage(entries_binding, entries_);
  storage(pixels_binding, pixels_);
  storage(cell_ends_binding, cell_ends_);
  for (const Texels& each : texels_) bind_texels(gpu_, set, each.binding, each.view);
  bind_storage_image(gpu_, set, large_pixels_binding, large_pixels_);
}

void TileBuffers::clear_pixels(const vk::raii::CommandBuffer& commands) const {
  constexpr std::uint32_t none = 0xFFFFFFFF;
  commands.fillBuffer(pixels_.get(), 0, plane_, 0);
  commands.fillBuffer(pixels_.get(), plane_, plane_, none);
}

void TileBuffers::poison() const {
  for (const Buffer* each : {&camera_spheres_, &kept_, &entries_}) mark_unwritten(gpu_, *each);
}

void TileBuffers::clear(const vk::raii::CommandBuffer& commands) const {
  commands.fillBuffer(tiles_.get(), 0, VK_WHOLE_SIZE, 0);
  if (small_) clear_pixels(commands);
}

// Sets the counts of a round to 0. The first word, which counts small spheres, stays unchanged.
void TileBuffers::start_round(const vk::raii::CommandBuffer& commands) const {
  commands.fillBuffer(tiles_.get(), word, 5 * word, 0);
  barrier(commands);
}

void TileBuffers::dispatch_listed(const vk::raii::CommandBuffer& commands) const {
  commands.dispatchIndirect(tiles_.get(), groups_at);
}

}  // namespace triptych::vulkan_backend
