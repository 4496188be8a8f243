#pragma once
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "backends/vulkan/vulkan.hpp"

namespace triptych::vulkan_backend {

// The loader and a VkInstance, with the validation layer if the environment variable asks for it.
class Instance {
 public:
  // Throws core::ApiError if there is no loader, no driver or no validation layer.
  Instance();

  [[nodiscard]] const vk::raii::Instance& get() const noexcept { return instance_; }
  [[nodiscard]] std::vector<vk::raii::PhysicalDevice> physical_devices() const;

  // Whether objects and commands can be named, and names are requested (TRIPTYCH_LABELS).
  [[nodiscard]] bool labels() const noexcept { return labels_; }

  // Throws core::ApiError with the first message of the validation layer since the last call.
  void check_validation() const;

 private:
  struct Report {
    std::mutex mutex;  // the layer may report from any thread of the driver
    std::vector<std::string> messages;
  };
  // Vulkan's callback. Vulkan-Hpp expects the types of the C API up to 1.3 and its own in 1.4, so
  // they are deduced from the member to which it is assigned.
  template <typename Severity, typename Types, typename Data>
  static VKAPI_ATTR VkBool32 VKAPI_CALL keep_message(Severity severity, Types types,
                                                     const Data* data, void* report);

  std::unique_ptr<Report> report_ = std::make_unique<Report>();
  vk::raii::Context context_;
  bool labels_;
  vk::raii::Instance instance_;
  vk::raii::DebugUtilsMessengerEXT messenger_;
};

}  // namespace triptych::vulkan_backend
