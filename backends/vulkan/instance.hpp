#pragma once
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "backends/vulkan/vulkan.hpp"

namespace triptych::vulkan_backend {

// The Vulkan loader and a VkInstance, with the validation layer if the environment variable
// requests it.
class Instance {
 public:
  // Throws core::ApiError if the loader, a driver or the requested validation layer is missing.
  Instance();

  [[nodiscard]] const vk::raii::Instance& get() const noexcept { return instance_; }
  [[nodiscard]] std::vector<vk::raii::PhysicalDevice> physical_devices() const;

  // Returns whether objects and commands can be named and names are requested (TRIPTYCH_LABELS).
  [[nodiscard]] bool labels() const noexcept { return labels_; }

  // Throws core::ApiError with the first message that the validation layer sent since the previous
  // call.
  void check_validation() const;

 private:
  struct Report {
    std::mutex mutex;  // the layer may report from any of the driver's threads
    std::vector<std::string> messages;
  };
  // The callback for Vulkan's messages. Its parameter types are deduced from the member to which it
  // is assigned, because Vulkan-Hpp expects the types of the C API up to version 1.3, and its own
  // types in 1.4.
  template <typename Severity, typename Types, typename Data>
  static VKAPI_ATTR VkBool32 VKAPI_CALL record_message(Severity severity, Types types,
                                                       const Data* data, void* report);

  std::unique_ptr<Report> report_ = std::make_unique<Report>();
  vk::raii::Context context_;
  bool labels_;
  vk::raii::Instance instance_;
  vk::raii::DebugUtilsMessengerEXT messenger_;
};

}  // namespace triptych::vulkan_backend
