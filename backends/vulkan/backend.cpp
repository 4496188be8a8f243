#include "backends/vulkan/backend.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <exception>
#include <utility>

#include "backends/vulkan/device.hpp"
#include "backends/vulkan/devices.hpp"
#include "backends/vulkan/errors.hpp"
#include "backends/vulkan/instance.hpp"
#include "core/error.hpp"

namespace triptych::vulkan_backend {
namespace {

class Backend final : public measure::Backend {
 public:
  [[nodiscard]] std::string_view api() const override { return "vulkan"; }

  [[nodiscard]] measure::Listing list() const override {
    measure::Listing listing;
    try {
      const Instance instance;
      for (const Candidate& each : candidates(instance.physical_devices())) {
        if (each.reason.empty()) {
          listing.devices.push_back(each.info);
        } else {
          listing.broken.push_back({"Vulkan device " + each.info.name, each.reason});
        }
      }
    } catch (const std::exception& error) {
      listing.broken.push_back({"Vulkan loader", error.what()});
    }
    return listing;
  }

  [[nodiscard]] std::unique_ptr<measure::Device> open(std::string_view device_id) const override {
    auto instance = std::make_unique<const Instance>();
    for (Candidate& each : candidates(instance->physical_devices())) {
      if (each.info.id != device_id) continue;
      if (!each.reason.empty()) throw core::NotSupported(each.reason);
      if (std::getenv("LP_PERF") != nullptr && each.info.driver == "llvmpipe") {
        throw core::NotSupported(
            "the environment variable LP_PERF is set, which makes the driver skip work; unset it");
      }
      return translated(
          [&] { return std::make_unique<Device>(std::move(instance), std::move(each)); });
    }
    throw core::NotSupported(fmt::format("no Vulkan device '{}'", device_id));
  }
};

}  // namespace

std::unique_ptr<measure::Backend> make_backend() {
  return std::make_unique<Backend>();
}

}  // namespace triptych::vulkan_backend
