// Simulates the memory of a graphics card: the host cannot access device memory.
#include <algorithm>
#include <array>
#include <mutex>
#include <set>

#include "tests/layer/chain.hpp"
#include "tests/layer/change.hpp"

namespace triptych::layer {
namespace {

// The memory types that this layer reports to Triptych. The driver has only type 0, from which the
// memory of both types is allocated.
enum Type : std::uint32_t { on_device, on_host, types };

std::mutex mutex;
std::set<VkDeviceMemory> host_inaccessible;  // memory that the host cannot access

bool has_separate_heaps() {
  return is_requested("hostVisibleDeviceLocal");
}

VKAPI_ATTR void VKAPI_CALL memory_properties(VkPhysicalDevice physical,
                                             VkPhysicalDeviceMemoryProperties* memory) {
  next<PFN_vkGetPhysicalDeviceMemoryProperties>(physical, "vkGetPhysicalDeviceMemoryProperties")(
      physical, memory);
  if (is_requested("memoryHeapSize"))
    memory->memoryHeaps[0].size = requested_number("memoryHeapSize");
  if (is_requested("emptyHeap")) {
    // A heap of 0 bytes comes first, as in the lists of some drivers.
    memory->memoryHeapCount = memory->memoryTypeCount = 2;
    memory->memoryHeaps[1] = memory->memoryHeaps[0];
    memory->memoryHeaps[1].flags = 0;
    memory->memoryHeaps[0] = {.size = 0, .flags = VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
    memory->memoryTypes[1] = {memory->memoryTypes[0].propertyFlags, 1};
    memory->memoryTypes[0] = {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
  }
  if (!has_separate_heaps()) return;
  memory->memoryHeapCount = types;
  memory->memoryHeaps[on_host] = {.size = memory->memoryHeaps[0].size, .flags = 0};
  memory->memoryHeaps[on_device].flags = VK_MEMORY_HEAP_DEVICE_LOCAL_BIT;
  memory->memoryTypeCount = types;
  memory->memoryTypes[on_device] = {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, on_device};
  memory->memoryTypes[on_host] = {
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, on_host};
}

VKAPI_ATTR void VKAPI_CALL buffer_needs(VkDevice device, VkBuffer buffer,
                                        VkMemoryRequirements* needs) {
  next<PFN_vkGetBufferMemoryRequirements>(device, "vkGetBufferMemoryRequirements")(device, buffer,
                                                                                   needs);
  if (has_separate_heaps() || is_requested("emptyHeap"))
    needs->memoryTypeBits = 1U << on_device | 1U << on_host;
}

VKAPI_ATTR void VKAPI_CALL image_needs(VkDevice device, VkImage image,
                                       VkMemoryRequirements* needs) {
  next<PFN_vkGetImageMemoryRequirements>(device, "vkGetImageMemoryRequirements")(device, image,
                                                                                 needs);
  if (is_requested("emptyHeap")) needs->memoryTypeBits = 1U << on_device | 1U << on_host;
}

VKAPI_ATTR VkResult VKAPI_CALL allocate(VkDevice device, const VkMemoryAllocateInfo* info,
                                        const VkAllocationCallbacks* allocator,
                                        VkDeviceMemory* memory) {
  if (is_requested("memoryHeapSize") && info->allocationSize > requested_number("memoryHeapSize")) {
    return refuse("vkAllocateMemory: more than the size of the heap");
  }
  if (is_requested("maxMemoryAllocationSize") &&
      info->allocationSize > requested_number("maxMemoryAllocationSize")) {
    return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  }
  if (is_requested("emptyHeap") && info->memoryTypeIndex == 0) {
    return refuse("vkAllocateMemory from a heap of 0 bytes");
  }
  VkMemoryAllocateInfo below = *info;
  if (has_separate_heaps() || is_requested("emptyHeap")) below.memoryTypeIndex = 0;
  const VkResult result =
      next<PFN_vkAllocateMemory>(device, "vkAllocateMemory")(device, &below, allocator, memory);
  if (result == VK_SUCCESS && has_separate_heaps()) {
    const std::lock_guard lock(mutex);
    if (info->memoryTypeIndex == on_device) {
      host_inaccessible.insert(*memory);
    } else {
      host_inaccessible.erase(*memory);
    }
  }
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL map(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset,
                                   VkDeviceSize size, VkMemoryMapFlags flags, void** data) {
  {
    const std::lock_guard lock(mutex);
    if (host_inaccessible.contains(memory))
      return refuse("vkMapMemory of memory that the host cannot access");
  }
  return next<PFN_vkMapMemory>(device, "vkMapMemory")(device, memory, offset, size, flags, data);
}

}  // namespace

std::span<const Hook> memory_hooks() {
  static const std::array hooks{hook("", "vkGetPhysicalDeviceMemoryProperties", &memory_properties),
                                hook("", "vkGetBufferMemoryRequirements", &buffer_needs),
                                hook("", "vkGetImageMemoryRequirements", &image_needs),
                                hook("", "vkAllocateMemory", &allocate),
                                hook("", "vkMapMemory", &map)};
  return hooks;
}

}  // namespace triptych::layer
