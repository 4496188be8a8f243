#include "backends/null/backend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "backends/null/device.hpp"
#include "core/error.hpp"

namespace triptych::null_backend {
namespace {

class NullBackend final : public measure::Backend {
 public:
  // `error` is the reason why the script in the environment cannot be used; empty if it can.
  NullBackend(std::shared_ptr<const Script> script, std::string error)
      : script_(std::move(script)), error_(std::move(error)) {}

  std::string_view api() const override { return "null"; }

  measure::Listing list() const override {
    measure::Listing listing;
    if (script_) trigger_failure(*script_, Place::list, "null");
    if (script_) listing.devices = devices_of(*script_);
    if (!error_.empty()) listing.broken.push_back({"TRIPTYCH_NULL_SCRIPT", error_});
    return listing;
  }

  std::unique_ptr<measure::Device> open(std::string_view device_id) const override {
    if (!error_.empty()) throw core::InputError("TRIPTYCH_NULL_SCRIPT: " + error_);
    const std::vector<record::Device> devices =
        script_ ? devices_of(*script_) : std::vector<record::Device>{};
    const auto found = std::ranges::find(devices, device_id, &record::Device::id);
    if (found == devices.end()) {
      throw core::NotSupported(
          fmt::format("the null backend has no device '{}'{}", device_id,
                      script_ ? "" : "; it has devices only if TRIPTYCH_NULL_SCRIPT is set"));
    }
    log_call(*script_, fmt::format("open {}", device_id));
    trigger_failure(*script_, Place::open, found->id);
    return make_device(script_, static_cast<std::size_t>(found - devices.begin()));
  }

 private:
  std::shared_ptr<const Script> script_;
  std::string error_;
};

}  // namespace

std::unique_ptr<measure::Backend> make_backend() {
  const char* const json = std::getenv("TRIPTYCH_NULL_SCRIPT");
  if (json == nullptr) return std::make_unique<NullBackend>(nullptr, "");
  try {
    return make_backend(parse_script(json));
  } catch (const core::InputError& error) {
    return std::make_unique<NullBackend>(nullptr, error.what());
  }
}

std::unique_ptr<measure::Backend> make_backend(Script script) {
  return std::make_unique<NullBackend>(std::make_shared<const Script>(std::move(script)), "");
}

}  // namespace triptych::null_backend
