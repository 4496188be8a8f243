#include "backends/opencl/backend.hpp"

#include <fmt/format.h>

#include "backends/opencl/device.hpp"
#include "backends/opencl/devices.hpp"
#include "core/error.hpp"

namespace triptych::opencl_backend {
namespace {

class Backend final : public measure::Backend {
 public:
  [[nodiscard]] std::string_view api() const override { return "opencl"; }

  [[nodiscard]] measure::Listing list() const override {
    Search search = find_devices();
    measure::Listing listing{.devices = {}, .broken = std::move(search.broken)};
    for (Found& each : search.found) listing.devices.push_back(std::move(each.info));
    return listing;
  }

  [[nodiscard]] std::unique_ptr<measure::Device> open(std::string_view device_id) const override {
    Search search = find_devices();
    for (Found& each : search.found) {
      if (each.info.id == device_id) return open_device(std::move(each));
    }
    std::string message = fmt::format("no OpenCL device '{}'", device_id);
    for (const Found& each : search.found) message += fmt::format("; available: {}", each.info.id);
    for (const auto& each : search.broken)
      message += fmt::format("; {}: {}", each.what, each.reason);
    throw core::NotSupported(message);
  }
};

}  // namespace

std::unique_ptr<measure::Backend> make_backend() {
  return std::make_unique<Backend>();
}

}  // namespace triptych::opencl_backend
