#include "backends/vulkan/cell_occlusion.hpp"

#include <span>

namespace triptych::vulkan_backend {
namespace {

// The bindings of technique/particles/occlusion.glsl and of shaders/farthest.comp.
enum OcclusionBinding : std::uint32_t {
  before_binding = 8,
  now_binding,
  farthest_binding,
  depths_binding,
  end_of_bindings
};
constexpr std::uint32_t cull_block_edge = 16;

std::uint32_t blocks(std::uint32_t pixels) {
  return (pixels + cull_block_edge - 1) / cull_block_edge;
}

// Before the first frame, all cells (ranges of neighbouring particles) count as visible.
Buffer all_visible(const Gpu& gpu, std::uint32_t cells) {
  const std::vector<std::uint32_t> ones(cells + 1, 1U);
  return make_buffer(
      gpu, std::as_bytes(std::span(ones)),
      vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferSrc);
}

Buffer words(const Gpu& gpu, std::uint32_t count) {
  return {gpu, vk::DeviceSize{count} * sizeof(std::uint32_t),
          vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferDst,
          Place::device};
}

}  // namespace

std::vector<vk::DescriptorSetLayoutBinding> occlusion_bindings() {
  std::vector<vk::DescriptorSetLayoutBinding> all;
  for (std::uint32_t binding = before_binding; binding < end_of_bindings; ++binding) {
    all.push_back(storage_binding(binding, vk::ShaderStageFlagBits::eCompute));
  }
  return all;
}

CellOcclusion::CellOcclusion(const Gpu& gpu, const Layout& layout, std::uint32_t cells,
                             vk::Extent3D extent, const Specialization& constants)
    : gpu_(gpu),
      extent_(extent),
      visible_before_(all_visible(gpu, cells)),
      visible_now_(all_visible(gpu, cells)),
      farthest_(words(gpu, blocks(extent.width) * blocks(extent.height))),
      depths_(words(gpu, extent.width * extent.height)),
      pipeline_(compute_pipeline(gpu, layout, spirv("farthest.comp.spv"), constants)) {}

void CellOcclusion::bind(vk::DescriptorSet set) const {
  const auto storage = [&](std::uint32_t binding, const Buffer& buffer) {
    bind_buffer(gpu_, set, binding, vk::DescriptorType::eStorageBuffer, buffer);
  };
  storage(before_binding, visible_before_);
  storage(now_binding, visible_now_);
  storage(farthest_binding, farthest_);
  storage(depths_binding, depths_);
}

void CellOcclusion::start_frame(const vk::raii::CommandBuffer& commands) const {
  commands.copyBuffer(visible_now_.get(), visible_before_.get(),
                      vk::BufferCopy{.size = visible_now_.size()});
  barrier(commands);
}

void CellOcclusion::find_farthest(const vk::raii::CommandBuffer& commands,
                                  const Image& depth) const {
  barrier(commands);
  commands.copyImageToBuffer(
      depth.get(), vk::ImageLayout::eTransferSrcOptimal, depths_.get(),
      vk::BufferImageCopy{.imageSubresource = depth.layer(), .imageExtent = extent_});
  barrier(commands);
  commands.bindPipeline(vk::PipelineBindPoint::eCompute, pipeline_);
  commands.dispatch(blocks(extent_.width), blocks(extent_.height), 1);
  barrier(commands);
}

}  // namespace triptych::vulkan_backend
