#include "backends/vulkan/instance.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

#include "backends/vulkan/errors.hpp"
#include "core/error.hpp"

namespace triptych::vulkan_backend {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

bool validation_wanted() {
  const char* value = std::getenv("TRIPTYCH_VULKAN_VALIDATION");
  return value != nullptr && std::string_view(value) == "1";
}

vk::raii::Context load() {
  try {
    return vk::raii::Context();
  } catch (const vk::SystemError&) {
    throw;
  } catch (const std::runtime_error& error) {  // Vulkan-Hpp throws this if dlopen fails
    throw core::ApiError("dlopen(libvulkan)", "not found", error.what());
  }
}

bool labels_wanted(const vk::raii::Context& context) {
  const char* value = std::getenv("TRIPTYCH_LABELS");
  if (value == nullptr || std::string_view(value) != "1") return false;
  const auto extensions =
      translated([&] { return context.enumerateInstanceExtensionProperties(); });
  return std::ranges::any_of(extensions, [](const vk::ExtensionProperties& each) {
    return std::string_view(each.extensionName.data()) == VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  });
}

vk::raii::Instance make_instance(const vk::raii::Context& context, bool labels) {
  const vk::ApplicationInfo application{.pApplicationName = "triptych",
                                        .apiVersion = VK_API_VERSION_1_1};
  constexpr std::array<const char*, 1> layers{validation_layer};
  constexpr std::array<const char*, 2> extensions{VK_EXT_DEBUG_UTILS_EXTENSION_NAME,
                                                  VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
  constexpr auto hazards = vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
  const vk::ValidationFeaturesEXT features{.enabledValidationFeatureCount = 1,
                                           .pEnabledValidationFeatures = &hazards};
  vk::InstanceCreateInfo info{.pApplicationInfo = &application};
  if (labels) info.setEnabledExtensionCount(1).setPpEnabledExtensionNames(extensions.data());
  if (validation_wanted()) {
    info.setPEnabledLayerNames(layers).setPEnabledExtensionNames(extensions).setPNext(&features);
  }
  return translated([&] { return vk::raii::Instance(context, info); });
}

}  // namespace

template <typename Severity, typename Types, typename Data>
VKAPI_ATTR VkBool32 VKAPI_CALL Instance::record_message(Severity /*severity*/, Types /*types*/,
                                                        const Data* data, void* report) {
  auto& kept = *static_cast<Report*>(report);
  const std::lock_guard lock(kept.mutex);
  kept.messages.emplace_back(data->pMessage);
  return VK_FALSE;
}

Instance::Instance()
    : context_(load()),
      labels_(labels_wanted(context_)),
      instance_(make_instance(context_, labels_)),
      messenger_(nullptr) {
  if (!validation_wanted()) return;
  messenger_ = translated([&] {
    return vk::raii::DebugUtilsMessengerEXT(
        instance_, vk::DebugUtilsMessengerCreateInfoEXT{
                       .messageSeverity = vk::DebugUtilsMessageSeverityFlagBitsEXT::eWarning |
                                          vk::DebugUtilsMessageSeverityFlagBitsEXT::eError,
                       .messageType = vk::DebugUtilsMessageTypeFlagBitsEXT::eValidation,
                       .pfnUserCallback = &record_message,
                       .pUserData = report_.get(),
                   });
  });
}

std::vector<vk::raii::PhysicalDevice> Instance::physical_devices() const {
  return translated(
      [&] { return std::vector<vk::raii::PhysicalDevice>(vk::raii::PhysicalDevices(instance_)); });
}

void Instance::check_validation() const {
  const std::lock_guard lock(report_->mutex);
  if (report_->messages.empty()) return;
  const std::string first = report_->messages.front();
  report_->messages.clear();
  throw core::ApiError(validation_layer, "message", first);
}

}  // namespace triptych::vulkan_backend
