#include "backends/vulkan/devices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "backends/vulkan/errors.hpp"
#include "measure/system/compile_only.hpp"
#include "measure/system/cpu_features.hpp"
#include "record/device_id.hpp"

namespace triptych::vulkan_backend {
namespace {

// The environment variables that change generated code or images. Layers may change the image, so
// their variables are included. TRIPTYCH_LAYER belongs to Triptych's own test layer (tests/layer).
constexpr std::array<std::string_view, 11> code_variables{"LP_NUM_THREADS",
                                                          "LP_NATIVE_VECTOR_WIDTH",
                                                          "GALLIVM_PERF",
                                                          "GALLIVM_DEBUG",
                                                          "GALLIUM_OVERRIDE_CPU_CAPS",
                                                          "VK_ICD_FILENAMES",
                                                          "VK_DRIVER_FILES",
                                                          "TRIPTYCH_VULKAN_VALIDATION",
                                                          "VK_INSTANCE_LAYERS",
                                                          "VK_LAYER_PATH",
                                                          "TRIPTYCH_LAYER"};

std::string version_text(std::uint32_t version) {
  return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                     VK_API_VERSION_PATCH(version));
}

// Converts the name of a driver without a known short name to lower-case letters, digits and
// dashes.
std::string slug(std::string_view text) {
  std::string result;
  for (const char each : text) {
    const auto c = static_cast<unsigned char>(each);
    if (std::isalnum(c) != 0) {
      result += static_cast<char>(std::tolower(c));
    } else if (!result.empty() && result.back() != '-') {
      result += '-';
    }
  }
  while (result.ends_with('-')) result.pop_back();
  return result;
}

std::string short_name(vk::DriverId driver, std::string_view driver_name) {
  using enum vk::DriverId;
  static constexpr std::array<std::pair<vk::DriverId, std::string_view>, 14> names{{
      {eMesaLlvmpipe, "lavapipe"},
      {eGoogleSwiftshader, "swiftshader"},
      {eNvidiaProprietary, "nvidia"},
      {eMesaNvk, "nvk"},
      {eMesaRadv, "radv"},
      {eAmdOpenSource, "amdvlk"},
      {eAmdProprietary, "amd"},
      {eIntelOpenSourceMESA, "anv"},
      {eIntelProprietaryWindows, "intel"},
      {eMesaTurnip, "turnip"},
      {eMesaV3Dv, "v3dv"},
      {eMoltenvk, "moltenvk"},
      {eMesaVenus, "venus"},
      {eMesaDozen, "dozen"},
  }};
  const auto* found =
      std::ranges::find(names, driver, &std::pair<vk::DriverId, std::string_view>::first);
  return found != names.end() ? std::string(found->second) : slug(driver_name);
}

// Returns whether this is a layered driver, which forwards all work to another driver. The image
// depends on both drivers.
bool is_layered(vk::DriverId driver) {
  using enum vk::DriverId;
  return driver == eMesaVenus || driver == eMesaDozen || driver == eMoltenvk;
}

// Returns the device below a layered driver. The name contains it in parentheses: "Virtio-GPU Venus
// (llvmpipe (LLVM 15.0.6, 256 bits))", "Microsoft Direct3D12 (NVIDIA …)". For MoltenVK, it is the
// whole name.
std::string host_of(std::string_view device_name) {
  const std::size_t begin = device_name.find('(');
  const std::size_t end = device_name.rfind(')');
  if (begin == std::string_view::npos || end == std::string_view::npos || end < begin) {
    return std::string(device_name);
  }
  return std::string(device_name.substr(begin + 1, end - begin - 1));
}

std::string vendor_name(std::uint32_t id) {
  static constexpr std::array<std::pair<std::uint32_t, std::string_view>, 8> names{{
      {0x1002, "AMD"},
      {0x1010, "Imagination"},
      {0x106B, "Apple"},
      {0x10DE, "NVIDIA"},
      {0x13B5, "Arm"},
      {0x5143, "Qualcomm"},
      {0x8086, "Intel"},
      {0x10005, "Mesa"},
  }};
  const auto* found =
      std::ranges::find(names, id, &std::pair<std::uint32_t, std::string_view>::first);
  return found != names.end() ? std::string(found->second) : fmt::format("{:#06x}", id);
}

std::map<std::string, std::string> limits_of(const vk::raii::PhysicalDevice& device) {
  const vk::PhysicalDeviceProperties properties = device.getProperties();
  const vk::PhysicalDeviceFeatures features = device.getFeatures();
  const vk::PhysicalDeviceMemoryProperties memory = device.getMemoryProperties();
  const vk::PhysicalDeviceLimits& limits = properties.limits;
  const auto yes_no = [](vk::Bool32 value) { return value == VK_TRUE ? "yes" : "no"; };
  std::map<std::string, std::string> result{
      {"deviceType", vk::to_string(properties.deviceType)},
      {"maxImageDimension2D", fmt::to_string(limits.maxImageDimension2D)},
      {"maxImageDimension3D", fmt::to_string(limits.maxImageDimension3D)},
      {"maxStorageBufferRange", fmt::to_string(limits.maxStorageBufferRange)},
      {"maxComputeWorkGroupInvocations", fmt::to_string(limits.maxComputeWorkGroupInvocations)},
      {"subPixelPrecisionBits", fmt::to_string(limits.subPixelPrecisionBits)},
      {"subTexelPrecisionBits", fmt::to_string(limits.subTexelPrecisionBits)},
      {"pointSizeGranularity", fmt::to_string(limits.pointSizeGranularity)},
      {"timestampPeriod", fmt::to_string(limits.timestampPeriod)},
      {"timestampComputeAndGraphics", yes_no(limits.timestampComputeAndGraphics)},
      {"geometryShader", yes_no(features.geometryShader)},
      {"tessellationShader", yes_no(features.tessellationShader)},
      {"pipelineStatisticsQuery", yes_no(features.pipelineStatisticsQuery)},
      {"fragmentStoresAndAtomics", yes_no(features.fragmentStoresAndAtomics)},
      {"shaderFloat64", yes_no(features.shaderFloat64)},
  };
  for (std::uint32_t heap = 0; heap < memory.memoryHeapCount; ++heap) {
    result.emplace(fmt::format("memoryHeaps[{}]", heap),
                   fmt::format("{} B {}", memory.memoryHeaps[heap].size,
                               vk::to_string(memory.memoryHeaps[heap].flags)));
  }
  return result;
}

bool reports_driver(const vk::raii::PhysicalDevice& device, std::uint32_t api_version) {
  if (api_version >= VK_API_VERSION_1_2) return true;
  const auto extensions = device.enumerateDeviceExtensionProperties();
  return std::ranges::any_of(extensions, [](const vk::ExtensionProperties& each) {
    return std::string_view(each.extensionName.data()) == VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME;
  });
}

// The id of a device that only compiles names the driver and the GPU family, which environment
// variables selected. Therefore these variables are not recorded. The path of the driver is not
// recorded either, because it does not change the generated code.
void compile_only_for(const std::string& family, std::string_view driver, record::Device& info) {
  info.compiles_for = family;
  info.id = measure::compile_only_id("vulkan", driver, family);
  info.environment.clear();
  info.limits.erase("timestampPeriod");  // a device without hardware has no clock
}

Candidate candidate(vk::raii::PhysicalDevice device) {
  const vk::PhysicalDeviceProperties properties = device.getProperties();
  const std::string vendor = vendor_name(properties.vendorID);
  record::Device info{.id = "vulkan:" + slug(vendor),
                      .api = "vulkan",
                      .name = properties.deviceName.data(),
                      .vendor = vendor,
                      .driver = vendor,
                      .driver_version = version_text(properties.driverVersion),
                      .api_version = version_text(properties.apiVersion),
                      .cpu_features = {},
                      .environment = measure::set_variables(code_variables),
                      .limits = limits_of(device)};
  if (properties.deviceType == vk::PhysicalDeviceType::eCpu) {
    info.cpu_features = measure::cpu_features();
  }
  if (properties.apiVersion < VK_API_VERSION_1_1) {
    return {std::move(device), std::move(info),
            fmt::format("the device supports only Vulkan {}; Vulkan 1.1 is required",
                        version_text(properties.apiVersion))};
  }
  if (reports_driver(device, properties.apiVersion)) {
    const auto driver =
        device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>()
            .get<vk::PhysicalDeviceDriverProperties>();
    info.driver = driver.driverName.data();
    const std::string driver_id = short_name(driver.driverID, info.driver);
    info.id = "vulkan:" + driver_id;
    if (info.cpu_features.empty()) {
      const std::string family = measure::compiled_family(driver_id);
      if (!family.empty()) compile_only_for(family, driver_id, info);
    }
    const std::string_view version = driver.driverInfo.data();
    if (!version.empty()) info.driver_version = version.substr(0, version.find('\n'));
    if (is_layered(driver.driverID)) info.driver_version += " on " + host_of(info.name);
  }
  return {std::move(device), std::move(info), {}};
}

}  // namespace

std::vector<Candidate> candidates(std::vector<vk::raii::PhysicalDevice> devices) {
  std::vector<Candidate> result;
  std::map<std::string, int> seen;
  for (vk::raii::PhysicalDevice& device : devices) {
    Candidate each = translated([&] { return candidate(std::move(device)); });
    each.info.id = record::numbered_id(each.info.id, ++seen[each.info.id]);
    result.push_back(std::move(each));
  }
  return result;
}

}  // namespace triptych::vulkan_backend
