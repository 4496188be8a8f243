#include "tests/layer/chain.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <mutex>
#include <string>

#include "tests/layer/change.hpp"
#include "tests/layer/description.hpp"
#include "tests/layer/queues.hpp"

namespace triptych::layer {
namespace {

// The next layer below this one, for an instance or a device. `instance_commands` contains the
// instance commands that this layer needs. They must be looked up while vkCreateInstance runs,
// because afterwards the loader would return this layer's own functions.
struct Link {
  VkInstance instance = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;  // null if this is the link of an instance
  PFN_vkGetInstanceProcAddr instance_command = nullptr;
  PFN_vkGetDeviceProcAddr device_command = nullptr;
  std::map<std::string_view, PFN_vkVoidFunction> instance_commands = {};
};

struct State {
  std::mutex mutex;
  // the key is the dispatch table pointer at the beginning of a handle
  std::map<const void*, Link> links;
  bool refused = false;
};

State& state() {
  static State only;
  return only;
}

const void* key_of(const void* handle) {
  return *static_cast<const void* const*>(handle);
}

Link link_of(const void* handle) {
  const std::lock_guard lock(state().mutex);
  return state().links.at(key_of(handle));
}

void add_link(const void* handle, const Link& link) {
  const std::lock_guard lock(state().mutex);
  state().links[key_of(handle)] = link;
}

void remove_link(const void* key) {
  const std::lock_guard lock(state().mutex);
  state().links.erase(key);
}

// Finds the loader's create info in the pNext chain.
template <class Info>
Info* loader_info(const void* next, VkStructureType type) {
  for (auto* each = static_cast<const VkBaseInStructure*>(next); each != nullptr;
       each = each->pNext) {
    auto* info = reinterpret_cast<Info*>(const_cast<VkBaseInStructure*>(each));
    if (each->sType == type && info->function == VK_LAYER_LINK_INFO) return info;
  }
  return nullptr;
}

std::array<std::span<const Hook>, 8> all_hooks() {
  return {description_hooks(), memory_hooks(),        queue_hooks(),       refusal_hooks(),
          state_fault_hooks(), command_fault_hooks(), query_fault_hooks(), submission_hooks()};
}

std::map<std::string_view, PFN_vkVoidFunction> instance_commands_of(
    VkInstance instance, PFN_vkGetInstanceProcAddr below) {
  std::map<std::string_view, PFN_vkVoidFunction> instance_commands{
      {"vkDestroyInstance", below(instance, "vkDestroyInstance")}};
  for (const Hook& each : description_hooks()) {
    instance_commands.emplace(each.command, below(instance, each.command.data()));
  }
  for (const char* command :
       {"vkGetPhysicalDeviceMemoryProperties", "vkGetPhysicalDeviceQueueFamilyProperties"}) {
    instance_commands.emplace(command, below(instance, command));
  }
  return instance_commands;
}

bool known_fault(std::string_view name) {
  for (const std::span<const Hook> hooks : all_hooks()) {
    for (const Hook& each : hooks) {
      if (!each.change.empty() && each.change == name) return true;
    }
  }
  return false;
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info,
                                               const VkAllocationCallbacks* allocator,
                                               VkInstance* instance) {
  auto* loader = loader_info<VkLayerInstanceCreateInfo>(
      info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  const bool only_limits = std::ranges::all_of(changes(), known_limit, &Change::name);
  const bool one_fault = changes().size() == 1 && known_fault(changes().front().name);
  if (!only_limits && !one_fault) {
    std::fprintf(stderr, "layer: TRIPTYCH_LAYER=%s is neither a list of limits nor a fault\n",
                 requested().c_str());
    return VK_ERROR_VALIDATION_FAILED_EXT;  // by which Triptych recognizes the cause
  }
  const PFN_vkGetInstanceProcAddr below = loader->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  loader->u.pLayerInfo = loader->u.pLayerInfo->pNext;
  const auto create =
      reinterpret_cast<PFN_vkCreateInstance>(below(VK_NULL_HANDLE, "vkCreateInstance"));
  const VkResult result = create(info, allocator, instance);
  if (result != VK_SUCCESS) return result;
  add_link(*instance, {.instance = *instance,
                       .instance_command = below,
                       .instance_commands = instance_commands_of(*instance, below)});
  return result;
}

VKAPI_ATTR void VKAPI_CALL destroy_instance(VkInstance instance,
                                            const VkAllocationCallbacks* allocator) {
  const void* key = key_of(instance);
  next<PFN_vkDestroyInstance>(instance, "vkDestroyInstance")(instance, allocator);
  remove_link(key);
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical,
                                             const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* allocator,
                                             VkDevice* device) {
  if (info->pEnabledFeatures != nullptr && enables_hidden(*info->pEnabledFeatures)) {
    refuse("vkCreateDevice: " + requested());
    return VK_ERROR_FEATURE_NOT_PRESENT;
  }
  auto* loader = loader_info<VkLayerDeviceCreateInfo>(info->pNext,
                                                      VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  Link link = link_of(physical);
  const PFN_vkGetInstanceProcAddr below = loader->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link.device_command = loader->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  loader->u.pLayerInfo = loader->u.pLayerInfo->pNext;
  const auto create = reinterpret_cast<PFN_vkCreateDevice>(below(link.instance, "vkCreateDevice"));
  const std::vector<VkDeviceQueueCreateInfo> queues = queues_of_driver(*info);
  VkDeviceCreateInfo below_info = *info;
  below_info.pQueueCreateInfos = queues.data();
  const VkResult result = create(physical, &below_info, allocator, device);
  link.device = *device;
  if (result == VK_SUCCESS) add_link(*device, link);
  return result;
}

VKAPI_ATTR void VKAPI_CALL destroy_device(VkDevice device, const VkAllocationCallbacks* allocator) {
  const void* key = key_of(device);
  end_device();
  next<PFN_vkDestroyDevice>(device, "vkDestroyDevice")(device, allocator);
  remove_link(key);
}

VKAPI_ATTR VkResult VKAPI_CALL queue_submit(VkQueue queue, std::uint32_t count,
                                            const VkSubmitInfo* submits, VkFence fence) {
  if (state().refused) return VK_ERROR_UNKNOWN;
  return next<PFN_vkQueueSubmit>(queue, "vkQueueSubmit")(queue, count, submits, fence);
}

PFN_vkVoidFunction instance_command(VkInstance instance, const char* name);
PFN_vkVoidFunction device_command(VkDevice device, const char* name);

PFN_vkVoidFunction replacement(std::string_view name) {
  const std::string_view first = changes().front().name;
  const std::string_view wanted = known_limit(first) ? std::string_view() : first;
  for (const Hook& each : submission_hooks()) {
    if (each.change == wanted && each.command == name) return each.function;
  }
  const std::array always{hook("", "vkGetInstanceProcAddr", &instance_command),
                          hook("", "vkGetDeviceProcAddr", &device_command),
                          hook("", "vkCreateInstance", &create_instance),
                          hook("", "vkDestroyInstance", &destroy_instance),
                          hook("", "vkCreateDevice", &create_device),
                          hook("", "vkDestroyDevice", &destroy_device),
                          hook("", "vkQueueSubmit", &queue_submit)};
  for (const Hook& each : always) {
    if (each.command == name) return each.function;
  }
  for (const std::span<const Hook> hooks : all_hooks()) {
    for (const Hook& each : hooks) {
      const bool serves_every_change = each.command == "vkGetPhysicalDeviceProperties2";
      if ((each.change == wanted || serves_every_change) && each.command == name)
        return each.function;
    }
  }
  return nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instance_command(VkInstance instance, const char* name) {
  if (PFN_vkVoidFunction layer_function = replacement(name)) return layer_function;
  return instance == VK_NULL_HANDLE ? nullptr : next_of(instance, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL device_command(VkDevice device, const char* name) {
  const PFN_vkVoidFunction below = next_of(device, name);
  if (below == nullptr) return nullptr;
  const PFN_vkVoidFunction layer_function = replacement(name);
  return layer_function != nullptr ? layer_function : below;
}

}  // namespace

PFN_vkVoidFunction next_of(const void* handle, const char* command) {
  const Link link = link_of(handle);
  if (link.device != VK_NULL_HANDLE) return link.device_command(link.device, command);
  const auto found = link.instance_commands.find(command);
  return found != link.instance_commands.end() ? found->second
                                               : link.instance_command(link.instance, command);
}

VkResult refuse(std::string_view what) {
  std::fprintf(stderr, "layer: refused: %.*s\n", static_cast<int>(what.size()), what.data());
  state().refused = true;
  return VK_ERROR_UNKNOWN;
}

}  // namespace triptych::layer

extern "C" VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* version) {
  version->loaderLayerInterfaceVersion = CURRENT_LOADER_LAYER_INTERFACE_VERSION;
  version->pfnGetInstanceProcAddr = &triptych::layer::instance_command;
  version->pfnGetDeviceProcAddr = &triptych::layer::device_command;
  version->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}
