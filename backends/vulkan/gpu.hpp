#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "backends/vulkan/pipelines.hpp"
#include "backends/vulkan/vulkan.hpp"
#include "measure/contract/memory_ledger.hpp"

namespace triptych::vulkan_backend {

// An open device and the one queue that all work goes through. Outlives everything made from it.
struct Gpu {
  vk::raii::PhysicalDevice physical;
  vk::PhysicalDeviceProperties properties;
  vk::PhysicalDeviceMemoryProperties memory;
  vk::PhysicalDeviceFeatures features;  // those enabled
  std::uint32_t family = 0;
  bool draws = false;                // the queue takes draw calls
  std::uint32_t timestamp_bits = 0;  // 0: the queue has no clock
  vk::raii::Device device;
  vk::raii::Queue queue;
  vk::raii::CommandPool commands;
  std::unique_ptr<Pipelines> pipelines;
  measure::MemoryLedger held = {};  // by buffers and images

  [[nodiscard]] bool is_cpu() const {
    return properties.deviceType == vk::PhysicalDeviceType::eCpu;
  }
};

// Throws core::NotSupported when the device has no queue for compute work, vk::SystemError.
[[nodiscard]] Gpu open_gpu(const vk::raii::PhysicalDevice& physical);

using Recording = std::function<void(const vk::raii::CommandBuffer&)>;

// A primary command buffer in its initial state.
[[nodiscard]] vk::raii::CommandBuffer make_commands(const Gpu& gpu);

// Submits and waits for a fence; the wait sleeps.
void submit_and_wait(const Gpu& gpu, const vk::raii::CommandBuffer& commands,
                     const vk::raii::Fence& fence);

// Orders everything recorded after it behind all work submitted before, memory included.
void barrier(const vk::raii::CommandBuffer& commands);

// Records between two barriers, submits once, waits.
void run_once(const Gpu& gpu, const Recording& record);

}  // namespace triptych::vulkan_backend
