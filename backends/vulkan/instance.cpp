#include "backends/vulkan/instance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "backends/vulkan/errors.hpp"
#include "core/error.hpp"

namespace triptych::vulkan_backend {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

// The layer in tests/layer, which simulates one faulty driver. TRIPTYCH_LAYER selects the fault.
constexpr const char* fault_layer = "VK_LAYER_TRIPTYCH_test";
constexpr const char* how_to_build =
    "if it is Triptych's layer with driver faults, build it with cmake --build FOLDER --target "
    "triptych_layer, and set VK_LAYER_PATH to FOLDER/tests/layer";

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

bool validation_wanted() {
  return variable("TRIPTYCH_VULKAN_VALIDATION") == "1";
}

// Returns the layers that VK_INSTANCE_LAYERS names.
std::vector<std::string> requested_layers() {
  std::vector<std::string> layers;
  const std::string names = variable("VK_INSTANCE_LAYERS");
  for (std::string_view rest = names; !rest.empty();) {
    const std::size_t colon = rest.find(':');
    if (colon != 0) layers.emplace_back(rest.substr(0, colon));
    rest.remove_prefix(colon == std::string_view::npos ? rest.size() : colon + 1);
  }
  return layers;
}

std::string searched_folders() {
  const std::string path = variable("VK_LAYER_PATH");
  return path.empty() ? "the Vulkan loader's default folders, because VK_LAYER_PATH is not set"
                      : "VK_LAYER_PATH=" + path;
}

// Checks that the loader knows all layers that environment variables request. The loader itself
// ignores an unknown layer, so that everything would be measured without the layer.
void require_layers(const vk::raii::Context& context, const std::vector<std::string>& layers) {
  const std::string fault = variable("TRIPTYCH_LAYER");
  if (!fault.empty() && std::ranges::find(layers, fault_layer) == layers.end()) {
    throw core::InputError(fmt::format(
        "TRIPTYCH_LAYER={} has no effect, because VK_INSTANCE_LAYERS does not contain {}; set "
        "VK_INSTANCE_LAYERS={}, or unset TRIPTYCH_LAYER",
        fault, fault_layer, fault_layer));
  }
  if (layers.empty()) return;
  const auto offered = translated([&] { return context.enumerateInstanceLayerProperties(); });
  for (const std::string& layer : layers) {
    const bool found = std::ranges::any_of(
        offered, [&](const vk::LayerProperties& each) { return layer == each.layerName.data(); });
    if (found) continue;
    throw core::InputError(fmt::format("the layer {} in VK_INSTANCE_LAYERS was not found in {}; {}",
                                       layer, searched_folders(), how_to_build));
  }
}

// Converts the error of vkCreateInstance to an error that names the layer or the fault that caused
// it.
[[noreturn]] void rethrow_with_layers(const vk::SystemError& error,
                                      const std::vector<std::string>& layers) {
  const auto result = static_cast<vk::Result>(error.code().value());
  if (result == vk::Result::eErrorLayerNotPresent && !layers.empty()) {
    std::string names;
    for (const std::string& layer : layers) names += (names.empty() ? "" : ":") + layer;
    throw core::InputError(
        fmt::format("the library of a layer in VK_INSTANCE_LAYERS={} could not be loaded from {}; "
                    "{}",
                    names, searched_folders(), how_to_build));
  }
  // Only Triptych's layer returns this code.
  if (result == vk::Result::eErrorValidationFailedEXT) {
    throw core::InputError(fmt::format(
        "TRIPTYCH_LAYER={} is neither a fault that {} can simulate nor a list of Vulkan "
        "limits that it can lower; docs/validate.md lists the faults",
        variable("TRIPTYCH_LAYER"), fault_layer));
  }
  rethrow(error, core::CodePlace::current());
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
  if (variable("TRIPTYCH_LABELS") != "1") return false;
  const auto extensions =
      translated([&] { return context.enumerateInstanceExtensionProperties(); });
  return std::ranges::any_of(extensions, [](const vk::ExtensionProperties& each) {
    return std::string_view(each.extensionName.data()) == VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  });
}

vk::raii::Instance make_instance(const vk::raii::Context& context, bool labels) {
  const vk::ApplicationInfo application{.pApplicationName = "triptych",
                                        .apiVersion = VK_API_VERSION_1_1};
  // The layers are also requested by name, because the loader then returns an error if it cannot
  // load the library of a layer.
  const std::vector<std::string> requested = requested_layers();
  require_layers(context, requested);
  std::vector<const char*> layers;
  for (const std::string& layer : requested) layers.push_back(layer.c_str());
  if (validation_wanted()) layers.push_back(validation_layer);
  constexpr std::array<const char*, 2> extensions{VK_EXT_DEBUG_UTILS_EXTENSION_NAME,
                                                  VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
  constexpr auto hazards = vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
  const vk::ValidationFeaturesEXT features{.enabledValidationFeatureCount = 1,
                                           .pEnabledValidationFeatures = &hazards};
  vk::InstanceCreateInfo info{.pApplicationInfo = &application};
  if (labels) info.setEnabledExtensionCount(1).setPpEnabledExtensionNames(extensions.data());
  info.setPEnabledLayerNames(layers);
  if (validation_wanted()) info.setPEnabledExtensionNames(extensions).setPNext(&features);
  try {
    return {context, info};
  } catch (const vk::SystemError& error) {
    rethrow_with_layers(error, requested);
  }
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
