#include "tests/layer/queues.hpp"

#include <algorithm>
#include <atomic>

#include "tests/layer/chain.hpp"
#include "tests/layer/change.hpp"

namespace triptych::layer {
namespace {

// Whether the most recently created command pool supports graphics. Triptych uses only one pool.
std::atomic<bool> pool_draws = true;

// With `computeFamilyFirst`, the first queue family is one that supports neither graphics nor
// timestamps.
bool has_extra_family() {
  return is_requested("computeFamilyFirst");
}

std::uint32_t driver_family(std::uint32_t family) {
  return has_extra_family() && family > 0 ? family - 1 : family;
}

bool draws(std::uint32_t family) {
  return !is_requested("graphicsQueue") && (!has_extra_family() || family > 0);
}

VKAPI_ATTR void VKAPI_CALL families(VkPhysicalDevice physical, std::uint32_t* count,
                                    VkQueueFamilyProperties* properties) {
  const auto below = next<PFN_vkGetPhysicalDeviceQueueFamilyProperties>(
      physical, "vkGetPhysicalDeviceQueueFamilyProperties");
  std::uint32_t count_below = 0;
  below(physical, &count_below, nullptr);
  std::vector<VkQueueFamilyProperties> all(count_below);
  below(physical, &count_below, all.data());
  if (has_extra_family()) all.insert(all.begin(), all.front());
  for (std::uint32_t family = 0; family < all.size(); ++family) {
    if (!draws(family)) all[family].queueFlags &= ~VkQueueFlags{VK_QUEUE_GRAPHICS_BIT};
    const bool no_clock = is_requested("timestampValidBits") || (has_extra_family() && family == 0);
    if (no_clock) all[family].timestampValidBits = requested_number("timestampValidBits");
  }
  if (properties == nullptr) {
    *count = static_cast<std::uint32_t>(all.size());
    return;
  }
  *count = std::min(*count, static_cast<std::uint32_t>(all.size()));
  std::copy_n(all.begin(), *count, properties);
}

VKAPI_ATTR void VKAPI_CALL get_queue(VkDevice device, std::uint32_t family, std::uint32_t index,
                                     VkQueue* queue) {
  next<PFN_vkGetDeviceQueue>(device, "vkGetDeviceQueue")(device, driver_family(family), index,
                                                         queue);
}

VKAPI_ATTR VkResult VKAPI_CALL create_pool(VkDevice device, const VkCommandPoolCreateInfo* info,
                                           const VkAllocationCallbacks* allocator,
                                           VkCommandPool* pool) {
  VkCommandPoolCreateInfo below = *info;
  below.queueFamilyIndex = driver_family(info->queueFamilyIndex);
  pool_draws = draws(info->queueFamilyIndex);
  return next<PFN_vkCreateCommandPool>(device, "vkCreateCommandPool")(device, &below, allocator,
                                                                      pool);
}

VKAPI_ATTR void VKAPI_CALL begin_pass(VkCommandBuffer commands, const VkRenderPassBeginInfo* info,
                                      VkSubpassContents contents) {
  if (!pool_draws) refuse("vkCmdBeginRenderPass on a queue that does not draw");
  next<PFN_vkCmdBeginRenderPass>(commands, "vkCmdBeginRenderPass")(commands, info, contents);
}

VKAPI_ATTR void VKAPI_CALL write_timestamp(VkCommandBuffer commands, VkPipelineStageFlagBits stage,
                                           VkQueryPool pool, std::uint32_t query) {
  if (is_requested("timestampValidBits") && requested_number("timestampValidBits") == 0) {
    refuse("vkCmdWriteTimestamp: timestampValidBits = 0");
  }
  next<PFN_vkCmdWriteTimestamp>(commands, "vkCmdWriteTimestamp")(commands, stage, pool, query);
}

}  // namespace

std::vector<VkDeviceQueueCreateInfo> queues_of_driver(const VkDeviceCreateInfo& info) {
  std::vector<VkDeviceQueueCreateInfo> queues(info.pQueueCreateInfos,
                                              info.pQueueCreateInfos + info.queueCreateInfoCount);
  for (VkDeviceQueueCreateInfo& each : queues) {
    each.queueFamilyIndex = driver_family(each.queueFamilyIndex);
  }
  return queues;
}

std::span<const Hook> queue_hooks() {
  static const std::array hooks{hook("", "vkGetPhysicalDeviceQueueFamilyProperties", &families),
                                hook("", "vkGetDeviceQueue", &get_queue),
                                hook("", "vkCreateCommandPool", &create_pool),
                                hook("", "vkCmdBeginRenderPass", &begin_pass),
                                hook("", "vkCmdWriteTimestamp", &write_timestamp)};
  return hooks;
}

}  // namespace triptych::layer
