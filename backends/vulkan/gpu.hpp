#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "backends/vulkan/pipelines.hpp"
#include "backends/vulkan/vulkan.hpp"
#include "core/code_place.hpp"
#include "measure/contract/memory_ledger.hpp"

namespace triptych::vulkan_backend {

// Extensions that some techniques require. Each extension is enabled if the device supports it and
// all extensions on which it depends.
struct Extensions {
  bool acceleration_structure = false;
  bool ray_query = false;
  bool ray_pipeline = false;
  bool mesh_shader = false;
  std::uint32_t scratch_alignment = 1;     // minAccelerationStructureScratchOffsetAlignment
  std::uint64_t most_boxes = 0;            // maxPrimitiveCount
  std::uint32_t group_handle_bytes = 0;    // shaderGroupHandleSize
  std::uint32_t group_base_alignment = 1;  // shaderGroupBaseAlignment
  std::uint32_t mesh_vertices = 0;         // maxMeshOutputVertices
  std::uint32_t mesh_primitives = 0;       // maxMeshOutputPrimitives
  std::uint32_t mesh_invocations = 0;      // maxMeshWorkGroupInvocations
  std::uint32_t task_groups = 0;           // maxTaskWorkGroupCount[0]
};

// An open device and its only queue, which executes all work. Must outlive all objects that are
// created from it.
struct Gpu {
  vk::raii::PhysicalDevice physical;
  vk::PhysicalDeviceProperties properties;
  vk::PhysicalDeviceMemoryProperties memory;
  vk::PhysicalDeviceFeatures features;  // the enabled features
  Extensions extensions = {};
  std::uint32_t family = 0;
  bool draws = false;                // the queue supports graphics
  bool labelled = false;             // objects and commands get names for debuggers and profilers
  std::uint32_t timestamp_bits = 0;  // 0 if the queue has no clock
  std::uint64_t most_allocated = 0;  // the largest single allocation: maxMemoryAllocationSize
  vk::raii::Device device;
  vk::raii::Queue queue;
  vk::raii::CommandPool commands;
  std::unique_ptr<Pipelines> pipelines;
  bool executes = true;       // if false, submit_and_wait() throws and run_once() does nothing
  bool reports_code = false;  // VK_KHR_pipeline_executable_properties is enabled
  measure::MemoryLedger memory_ledger = {};  // memory of the buffers and images
  // The number of submissions so far, for error messages about a lost device.
  mutable std::uint64_t submissions = 0;

  [[nodiscard]] bool is_cpu() const {
    return properties.deviceType == vk::PhysicalDeviceType::eCpu;
  }
};

// Opens a device. `labelled` is true if the instance has VK_EXT_debug_utils and names were
// requested. `executes` is false for a device that only compiles, because its GPU is not present.
// Throws core::NotSupported if the device has no queue for compute work, and vk::SystemError.
[[nodiscard]] Gpu open_gpu(const vk::raii::PhysicalDevice& physical, bool labelled = false,
                           bool executes = true);

// While an object of this class exists, all recorded commands belong to a named group that
// debuggers and profilers display. Does nothing if names were not requested.
class Label {
 public:
  Label(const Gpu& gpu, const vk::raii::CommandBuffer& commands, const char* name);
  Label(const Label&) = delete;
  Label& operator=(const Label&) = delete;
  ~Label();

 private:
  const vk::raii::CommandBuffer* commands_;  // null if names were not requested
};

// Names an object for debuggers and profilers, by its kind and by the source location where it was
// created: "buffer of compute_frames.cpp:38".
void name_object(const Gpu& gpu, vk::ObjectType type, std::uint64_t handle, const char* what,
                 core::CodePlace place);

using Recording = std::function<void(const vk::raii::CommandBuffer&)>;

// Creates a primary command buffer in its initial state.
[[nodiscard]] vk::raii::CommandBuffer make_commands(const Gpu& gpu);

// Submits commands, and waits for a fence without spinning. All submissions use this function.
// Throws core::NotSupported on a device that only compiles.
void submit_and_wait(const Gpu& gpu, const vk::raii::CommandBuffer& commands,
                     const vk::raii::Fence& fence,
                     core::CodePlace place = core::CodePlace::current());

// Records a barrier: all later commands wait for all earlier work, including its memory accesses.
void barrier(const vk::raii::CommandBuffer& commands);

// Records commands between two barriers, submits them, and waits. Does nothing on a device that
// only compiles, because the data would never be read.
void run_once(const Gpu& gpu, const Recording& record,
              core::CodePlace place = core::CodePlace::current());

}  // namespace triptych::vulkan_backend
