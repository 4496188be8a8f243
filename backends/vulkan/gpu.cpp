#include "backends/vulkan/gpu.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "backends/vulkan/errors.hpp"
#include "backends/vulkan/extensions.hpp"
#include "core/error.hpp"
#include "measure/system/compile_only.hpp"

namespace triptych::vulkan_backend {
namespace {

// Returns the first queue family that supports compute and graphics or, if there is none, the first
// that supports compute.
std::uint32_t choose_family(const std::vector<vk::QueueFamilyProperties>& families,
                            const char* device_name) {
  constexpr auto both = vk::QueueFlagBits::eCompute | vk::QueueFlagBits::eGraphics;
  for (const vk::QueueFlags wanted :
       {vk::QueueFlags(both), vk::QueueFlags(vk::QueueFlagBits::eCompute)}) {
    for (std::uint32_t family = 0; family < families.size(); ++family) {
      if ((families[family].queueFlags & wanted) == wanted) return family;
    }
  }
  throw core::NotSupported(fmt::format("{} has no compute queue", device_name));
}

// Returns whether the driver reports its compiled code. This queries the feature in addition to the
// extension, because a driver may list the extension without supporting the feature.
bool reports_code(const vk::raii::PhysicalDevice& physical) {
  const auto extensions = physical.enumerateDeviceExtensionProperties();
  const bool listed = std::ranges::any_of(extensions, [](const vk::ExtensionProperties& each) {
    return std::string_view(each.extensionName.data()) ==
           VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
  });
  if (!listed) return false;
  using Feature = vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR;
  return physical.getFeatures2<vk::PhysicalDeviceFeatures2, Feature>()
             .get<Feature>()
             .pipelineExecutableInfo == VK_TRUE;
}

// The memory heaps of a GPU that is not present have 0 bytes. They are given a size, so that
// pipelines can be compiled for it. Nothing is ever written to these heaps.
vk::PhysicalDeviceMemoryProperties memory_of(const vk::raii::PhysicalDevice& physical,
                                             bool executes) {
  vk::PhysicalDeviceMemoryProperties memory = physical.getMemoryProperties();
  for (std::uint32_t heap = 0; !executes && heap < memory.memoryHeapCount; ++heap) {
    memory.memoryHeaps[heap].size = vk::DeviceSize{1} << 40;
  }
  return memory;
}

}  // namespace

Gpu open_gpu(const vk::raii::PhysicalDevice& physical, bool labelled, bool executes) {
  const vk::PhysicalDeviceProperties properties = physical.getProperties();
  const auto families = physical.getQueueFamilyProperties();
  const std::uint32_t family = choose_family(families, properties.deviceName.data());
  const vk::PhysicalDeviceFeatures offered = physical.getFeatures();
  const vk::PhysicalDeviceFeatures features{
      .geometryShader = offered.geometryShader,
      .tessellationShader = offered.tessellationShader,
      .multiDrawIndirect = offered.multiDrawIndirect,
      .drawIndirectFirstInstance = offered.drawIndirectFirstInstance,
      .largePoints = offered.largePoints,
      .pipelineStatisticsQuery = offered.pipelineStatisticsQuery,
      .vertexPipelineStoresAndAtomics = offered.vertexPipelineStoresAndAtomics,
      .fragmentStoresAndAtomics = offered.fragmentStoresAndAtomics,
      .shaderFloat64 = offered.shaderFloat64};
  const auto most_allocated =
      physical
          .getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceMaintenance3Properties>()
          .get<vk::PhysicalDeviceMaintenance3Properties>()
          .maxMemoryAllocationSize;
  constexpr float priority = 1.0F;
  const vk::DeviceQueueCreateInfo queue{
      .queueFamilyIndex = family, .queueCount = 1, .pQueuePriorities = &priority};
  const bool reports = reports_code(physical);
  const ExtensionRequest request(physical);
  std::vector<const char*> names = request.names();
  if (reports) names.push_back(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
  vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR info{.pNext = request.features(),
                                                                 .pipelineExecutableInfo = VK_TRUE};
  vk::raii::Device device(
      physical,
      vk::DeviceCreateInfo{.pNext = reports ? &info : request.features(),
                           .queueCreateInfoCount = 1,
                           .pQueueCreateInfos = &queue,
                           .enabledExtensionCount = static_cast<std::uint32_t>(names.size()),
                           .ppEnabledExtensionNames = names.data(),
                           .pEnabledFeatures = &features});
  vk::raii::Queue work = device.getQueue(family, 0);
  vk::raii::CommandPool commands(device, vk::CommandPoolCreateInfo{.queueFamilyIndex = family});
  return Gpu{.physical = physical,
             .properties = properties,
             .memory = memory_of(physical, executes),
             .features = features,
             .extensions = request.extensions(),
             .family = family,
             .draws = bool(families[family].queueFlags & vk::QueueFlagBits::eGraphics),
             .labelled = labelled,
             .timestamp_bits = families[family].timestampValidBits,
             .most_allocated = most_allocated,
             .device = std::move(device),
             .queue = std::move(work),
             .commands = std::move(commands),
             .pipelines = std::make_unique<Pipelines>(),
             .executes = executes,
             .reports_code = reports};
}

Label::Label(const Gpu& gpu, const vk::raii::CommandBuffer& commands, const char* name)
    : commands_(gpu.labelled ? &commands : nullptr) {
  if (commands_ != nullptr) commands_->beginDebugUtilsLabelEXT({.pLabelName = name});
}

Label::~Label() {
  if (commands_ != nullptr) commands_->endDebugUtilsLabelEXT();
}

void name_object(const Gpu& gpu, vk::ObjectType type, std::uint64_t handle, const char* what,
                 core::CodePlace place) {
  if (!gpu.labelled) return;
  const std::string_view file = place.file_name();
  const std::string name =
      fmt::format("{} of {}:{}", what, file.substr(file.rfind('/') + 1), place.line());
  gpu.device.setDebugUtilsObjectNameEXT(
      {.objectType = type, .objectHandle = handle, .pObjectName = name.c_str()});
}

vk::raii::CommandBuffer make_commands(const Gpu& gpu) {
  vk::raii::CommandBuffers buffers(
      gpu.device, vk::CommandBufferAllocateInfo{.commandPool = *gpu.commands,
                                                .level = vk::CommandBufferLevel::ePrimary,
                                                .commandBufferCount = 1});
  return std::move(buffers.front());
}

void submit_and_wait(const Gpu& gpu, const vk::raii::CommandBuffer& commands,
                     const vk::raii::Fence& fence, core::CodePlace place) {
  if (!gpu.executes) throw core::NotSupported(std::string(measure::only_compiles));
  ++gpu.submissions;
  try {
    gpu.queue.submit(vk::SubmitInfo{.commandBufferCount = 1, .pCommandBuffers = &*commands},
                     *fence);
    constexpr std::uint64_t for_ever = std::numeric_limits<std::uint64_t>::max();
    while (gpu.device.waitForFences(*fence, VK_TRUE, for_ever) == vk::Result::eTimeout) {
    }
  } catch (const vk::SystemError& error) {
    rethrow(error, place, fmt::format("submission {} of this process", gpu.submissions));
  }
}

void barrier(const vk::raii::CommandBuffer& commands) {
  using enum vk::AccessFlagBits;
  const vk::MemoryBarrier all{.srcAccessMask = eMemoryWrite,
                              .dstAccessMask = eMemoryRead | eMemoryWrite};
  commands.pipelineBarrier(vk::PipelineStageFlagBits::eAllCommands,
                           vk::PipelineStageFlagBits::eAllCommands, {}, all, {}, {});
}

void run_once(const Gpu& gpu, const Recording& record, core::CodePlace place) {
  if (!gpu.executes) return;
  const vk::raii::CommandBuffer commands = make_commands(gpu);
  const vk::raii::Fence fence(gpu.device, vk::FenceCreateInfo{});
  commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  {
    const Label label(gpu, commands, "outside of a frame: upload, overwrite or read back");
    barrier(commands);
    record(commands);
    barrier(commands);
  }
  commands.end();
  submit_and_wait(gpu, commands, fence, place);
}

}  // namespace triptych::vulkan_backend
