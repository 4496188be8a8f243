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

// Extensions that some techniques need. Each is enabled if the device has it and everything on
// which it depends.
struct Extensions {
  bool acceleration_structure = false;
  bool ray_query = false;
  bool ray_pipeline = false;
  bool mesh_shader = false;
  std::uint32_t scratch_alignment = 1;      // minAccelerationStructureScratchOffsetAlignment
  std::uint64_t most_boxes = 0;             // maxPrimitiveCount
  std::uint32_t group_handle_bytes = 0;     // shaderGroupHandleSize
  std::uint32_t group_base_alignment = 1;   // shaderGroupBaseAlignment
  std::uint32_t mesh_vertices = 0;          // maxMeshOutputVertices
  std::uint32_t mesh_primitives = 0;        // maxMeshOutputPrimitives
  std::uint32_t mesh_invocations = 0;       // maxMeshWorkGroupInvocations
  std::uint32_t task_groups = 0;            // maxTaskWorkGroupCount along one axis
};

// An open device and its only queue, which does all work. It must outlive all objects that are made
// from it.
struct Gpu {
  vk::raii::PhysicalDevice physical;
  vk::PhysicalDeviceProperties properties;
  vk::PhysicalDeviceMemoryProperties memory;
  vk::PhysicalDeviceFeatures features;  // the enabled ones
  Extensions extensions = {};
  std::uint32_t family = 0;
  bool draws = false;                // the queue takes draw calls
  bool labelled = false;             // objects and commands are named for tools
  std::uint32_t timestamp_bits = 0;  // 0 if the queue has no clock
  std::uint64_t most_allocated = 0;  // the largest single allocation: maxMemoryAllocationSize
  vk::raii::Device device;
  vk::raii::Queue queue;
  vk::raii::CommandPool commands;
  std::unique_ptr<Pipelines> pipelines;
  bool executes = true;       // if false, submit_and_wait() throws and run_once() does nothing
  bool reports_code = false;  // VK_KHR_pipeline_executable_properties is enabled
  measure::MemoryLedger held = {};  // memory of buffers and images
  // The number of submissions so far: the error about a lost device contains it.
  mutable std::uint64_t submissions = 0;

  [[nodiscard]] bool is_cpu() const {
    return properties.deviceType == vk::PhysicalDeviceType::eCpu;
  }
};

// Throws core::NotSupported if the device has no queue for compute work, and vk::SystemError.
// `labelled`: its instance has VK_EXT_debug_utils, and names are requested. `executes`: false for a
// device that only compiles.
[[nodiscard]] Gpu open_gpu(const vk::raii::PhysicalDevice& physical, bool labelled = false,
                           bool executes = true);

// Names the commands that are recorded while this object lives, for tools that show the names. Does
// nothing if names were not requested.
class Label {
 public:
  Label(const Gpu& gpu, const vk::raii::CommandBuffer& commands, const char* name);
  Label(const Label&) = delete;
  Label& operator=(const Label&) = delete;
  ~Label();

 private:
  const vk::raii::CommandBuffer* commands_;  // null if names were not requested
};

// Names an object of the device for such tools, by its kind and the line of code that made it:
// "buffer of compute_frames.cpp:38".
void name_object(const Gpu& gpu, vk::ObjectType type, std::uint64_t handle, const char* what,
                 core::CodePlace place);

using Recording = std::function<void(const vk::raii::CommandBuffer&)>;

// A primary command buffer in its initial state.
[[nodiscard]] vk::raii::CommandBuffer make_commands(const Gpu& gpu);

// Submits and waits for a fence without spinning. All submissions go through here. Throws
// core::NotSupported on a device that only compiles.
void submit_and_wait(const Gpu& gpu, const vk::raii::CommandBuffer& commands,
                     const vk::raii::Fence& fence,
                     core::CodePlace place = core::CodePlace::current());

// Records a barrier: all later commands wait for all work that was submitted before, including its
// memory accesses.
void barrier(const vk::raii::CommandBuffer& commands);

// Records between two barriers, submits once, and waits. On a device that only compiles it does
// nothing, because nobody would read the data.
void run_once(const Gpu& gpu, const Recording& record,
              core::CodePlace place = core::CodePlace::current());

}  // namespace triptych::vulkan_backend
