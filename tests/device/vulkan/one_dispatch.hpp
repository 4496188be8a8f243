#pragma once
// Runs one compute shader that reads a storage buffer (binding 0) and writes another (binding 1).

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "backends/vulkan/descriptors.hpp"
#include "backends/vulkan/memory.hpp"
#include "backends/vulkan/pipeline.hpp"

namespace triptych::vulkan_backend {

template <typename Out, typename In>
std::vector<Out> dispatch_once(const Gpu& gpu, std::string_view spirv, const std::vector<In>& in,
                               std::uint32_t groups) {
  using enum vk::DescriptorType;
  constexpr auto stage = vk::ShaderStageFlagBits::eCompute;
  const std::array<vk::DescriptorSetLayoutBinding, 2> bindings{{
      {.binding = 0, .descriptorType = eStorageBuffer, .descriptorCount = 1, .stageFlags = stage},
      {.binding = 1, .descriptorType = eStorageBuffer, .descriptorCount = 1, .stageFlags = stage},
  }};
  const Layout layout = make_layout(gpu, bindings);
  const vk::Pipeline pipeline = compute_pipeline(gpu, layout, spirv, Constants{});
  const vk::raii::DescriptorPool pool = make_pool(gpu, 1);
  const vk::DescriptorSet set = allocate_sets(gpu, pool, layout, 1).front();
  std::vector<Out> out(in.size());
  const Buffer from =
      make_buffer(gpu, std::as_bytes(std::span(in)), vk::BufferUsageFlagBits::eStorageBuffer);
  const Buffer to(gpu, std::as_bytes(std::span(out)).size(),
                  vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferSrc,
                  Place::device);
  bind_buffer(gpu, set, 0, eStorageBuffer, from);
  bind_buffer(gpu, set, 1, eStorageBuffer, to);
  run_once(gpu, [&](const vk::raii::CommandBuffer& commands) {
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout.pipeline, 0, set, {});
    commands.dispatch(groups, 1, 1);
  });
  download(gpu, to, std::as_writable_bytes(std::span(out)));
  return out;
}

}  // namespace triptych::vulkan_backend
