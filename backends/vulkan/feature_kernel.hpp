#pragma once
// Helpers for the feature probes (features.hpp).

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "backends/vulkan/descriptors.hpp"
#include "backends/vulkan/memory.hpp"
#include "backends/vulkan/pipeline.hpp"
#include "measure/contract/features.hpp"

namespace triptych::vulkan_backend {

inline constexpr auto storage_usage = vk::BufferUsageFlagBits::eStorageBuffer |
                                      vk::BufferUsageFlagBits::eTransferSrc |
                                      vk::BufferUsageFlagBits::eTransferDst;

struct NoConstants {
  std::int32_t unused = 0;
};

// A kernel without specialization constants. Its last binding is the buffer for its results.
class Kernel {
 public:
  Kernel(const Gpu& gpu, std::string_view shader, const std::vector<vk::DescriptorType>& bindings,
         std::uint32_t push_bytes = 0)
      : gpu_(gpu),
        layout_(make_layout(gpu, described(bindings), push_bytes)),
        pool_(make_feature_pool(gpu, bindings)),
        set_(allocate_sets(gpu, pool_, layout_, 1).front()),
        pipeline_(compute_pipeline(gpu, layout_, spirv(shader), Specialization(NoConstants{}))) {}

  [[nodiscard]] vk::DescriptorSet set() const { return set_; }

  // Binds part of a buffer.
  void bind_range(std::uint32_t binding, vk::DescriptorType type, const Buffer& buffer,
                  vk::DeviceSize offset, vk::DeviceSize range) const {
    const vk::DescriptorBufferInfo info{.buffer = buffer.get(), .offset = offset, .range = range};
    gpu_.device.updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = set_,
                                                            .dstBinding = binding,
                                                            .descriptorCount = 1,
                                                            .descriptorType = type,
                                                            .pBufferInfo = &info},
                                     {});
  }

  template <class Push>
  void record(const vk::raii::CommandBuffer& commands, const Push& push,
              const std::array<std::uint32_t, 3>& groups,
              const std::vector<std::uint32_t>& dynamic_offsets = {}) const {
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, pipeline_);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_.pipeline, 0, set_,
                                dynamic_offsets);
    commands.pushConstants<Push>(*layout_.pipeline, vk::ShaderStageFlagBits::eCompute, 0, push);
    commands.dispatch(groups[0], groups[1], groups[2]);
  }

  void record(const vk::raii::CommandBuffer& commands,
              const std::array<std::uint32_t, 3>& groups) const {
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, pipeline_);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_.pipeline, 0, set_, {});
    commands.dispatch(groups[0], groups[1], groups[2]);
  }

 private:
  static std::vector<vk::DescriptorSetLayoutBinding> described(
      const std::vector<vk::DescriptorType>& bindings) {
    std::vector<vk::DescriptorSetLayoutBinding> all;
    for (const vk::DescriptorType type : bindings) {
      all.push_back({.binding = static_cast<std::uint32_t>(all.size()),
                     .descriptorType = type,
                     .descriptorCount = 1,
                     .stageFlags = vk::ShaderStageFlagBits::eCompute});
    }
    return all;
  }

  static vk::raii::DescriptorPool make_feature_pool(
      const Gpu& gpu, const std::vector<vk::DescriptorType>& bindings) {
    std::vector<vk::DescriptorPoolSize> sizes;
    for (const vk::DescriptorType type : bindings) {
      sizes.push_back({.type = type, .descriptorCount = 1});
    }
    return {gpu.device,
            vk::DescriptorPoolCreateInfo{.maxSets = 1,
                                         .poolSizeCount = static_cast<std::uint32_t>(sizes.size()),
                                         .pPoolSizes = sizes.data()}};
  }

  const Gpu& gpu_;
  Layout layout_;
  vk::raii::DescriptorPool pool_;
  vk::DescriptorSet set_;
  vk::Pipeline pipeline_;
};

inline constexpr auto storage_type = vk::DescriptorType::eStorageBuffer;

[[nodiscard]] inline Buffer result_buffer(const Gpu& gpu, std::size_t words) {
  Buffer buffer(gpu, words * sizeof(std::uint32_t), storage_usage, Place::device);
  mark_unwritten(gpu, buffer);
  return buffer;
}

template <class Value>
[[nodiscard]] std::vector<Value> read_back(const Gpu& gpu, const Buffer& buffer,
                                           std::size_t count) {
  std::vector<Value> values(count);
  download(gpu, buffer, std::as_writable_bytes(std::span(values)));
  return values;
}

// The probes that draw (feature_draws.cpp).
[[nodiscard]] measure::ProbedFeature probe_indirect_draws(const Gpu& gpu);
[[nodiscard]] measure::ProbedFeature probe_instances(const Gpu& gpu);
[[nodiscard]] measure::ProbedFeature probe_base_vertex(const Gpu& gpu);

}  // namespace triptych::vulkan_backend
