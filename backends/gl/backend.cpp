#include "backends/gl/backend.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "backends/gl/context.hpp"
#include "backends/gl/device.hpp"
#include "backends/gl/device_info.hpp"
#include "backends/gl/isolate.hpp"
#include "core/error.hpp"
#include "core/json_text.hpp"
#include "measure/system/compile_only.hpp"
#include "record/device_id.hpp"

namespace triptych::gl_backend {
namespace {

constexpr std::array<WindowSystem, 2> window_systems{
    {{"EGL", "-egl", &egl_candidates}, {"OSMesa", "-osmesa", &osmesa_candidates}}};

// The time limit for a driver to report its name. A driver that takes longer counts as hung. A cold
// start takes 0.1 s.
constexpr std::chrono::seconds listing_limit{20};

struct Opened {
  record::Device info;
  std::unique_ptr<Context> context;
};

// Opens the devices of a window system one after another, and assigns an id to each of them.
class Walk {
 public:
  explicit Walk(const WindowSystem& system) : system_(system), candidates_(system.candidates()) {}

  // Returns the next device that can be opened, or nullopt if there are no more devices. For every
  // device that fails to open, adds the reason to `broken`.
  std::optional<Opened> next(bool debug, std::vector<measure::Broken>& broken) {
    while (at_ < candidates_.size()) {
      const Candidate& candidate = candidates_[at_++];
      try {
        Opened opened{{}, candidate.open(debug)};
        {
          const Current current(*opened.context);
          opened.info = device_info(opened.context->gl(), system_.suffix);
        }
        if (is_repeated(opened.info)) continue;
        opened.info.id = record::numbered_id(opened.info.id, ++count_[opened.info.id]);
        return opened;
      } catch (const core::Error& error) {
        broken.push_back({candidate.description, error.what()});
      }
    }
    return std::nullopt;
  }

 private:
  // Returns whether this is the second occurrence of the platform's default device, which is opened
  // first and then found again during enumeration.
  bool is_repeated(const record::Device& info) {
    if (at_ == 1) {
      first_ = info;
      return false;
    }
    if (!first_ || *first_ != info) return false;
    first_.reset();
    return true;
  }

  const WindowSystem& system_;
  std::vector<Candidate> candidates_;
  std::size_t at_ = 0;
  std::optional<record::Device> first_;  // the default device, until it is found again
  std::map<std::string, int> count_;     // number of devices found so far, by id
};

// Lists the devices as JSON, which the child process sends to its parent.
std::string list_as_text(const WindowSystem& system) {
  nlohmann::json devices = nlohmann::json::array();
  nlohmann::json reasons = nlohmann::json::array();
  std::vector<measure::Broken> broken;
  try {
    Walk walk(system);
    while (const auto opened = walk.next(false, broken)) devices.push_back(opened->info);
  } catch (const core::Error& error) {
    broken.push_back({std::string(system.name), error.what()});
  }
  for (const measure::Broken& each : broken) reasons.push_back({each.what, each.reason});
  return core::json_text({{"devices", devices}, {"broken", reasons}});
}

void add(const std::string& text, measure::Listing& listing) {
  const auto json = nlohmann::json::parse(text);
  for (const auto& device : json.at("devices")) {
    listing.devices.push_back(device.get<record::Device>());
  }
  for (const auto& broken : json.at("broken")) {
    listing.broken.push_back({broken.at(0).get<std::string>(), broken.at(1).get<std::string>()});
  }
}

bool debug_wanted() {
  const char* value = std::getenv("TRIPTYCH_GL_DEBUG");
  return value != nullptr && std::string_view(value) == "1";
}

class GlBackend final : public measure::Backend {
 public:
  [[nodiscard]] std::string_view api() const override { return "gl"; }

  // Lists each window system in a child process. A driver that crashes or hangs therefore affects
  // nothing else, and listing never loads OSMesa and the Mesa library behind EGL into the same
  // process.
  [[nodiscard]] measure::Listing list() const override {
    measure::Listing listing;
    for (const WindowSystem& system : window_systems) {
      try {
        const ChildResult result =
            run_in_child([&system] { return list_as_text(system); }, listing_limit);
        if (result.failure.empty()) {
          add(result.text, listing);
        } else {
          listing.broken.push_back(
              {.what = fmt::format("gl ({})", system.name),
               .reason = {},
               .ended = record::Reason{.cause = record::Cause::error, .detail = result.failure}});
        }
      } catch (const std::exception& error) {  // also catches an answer that cannot be parsed
        listing.broken.push_back(
            {.what = fmt::format("gl ({})", system.name),
             .reason = {},
             .ended = record::Reason{.cause = record::Cause::bad_answer, .detail = error.what()}});
      }
    }
    return listing;
  }

  [[nodiscard]] std::unique_ptr<measure::Device> open(std::string_view device_id) const override {
    std::vector<measure::Broken> broken;
    for (const WindowSystem& system : window_systems) {
      if (!may_provide(system, device_id)) continue;
      try {
        Walk walk(system);
        // A device that only compiles needs a debug context, because compilers report the generated
        // code in debug messages.
        const bool debug = debug_wanted() || measure::compile_only(device_id).has_value();
        while (auto opened = walk.next(debug, broken)) {
          if (opened->info.id != device_id) continue;
          return make_device(std::move(opened->info), std::move(opened->context));
        }
      } catch (const core::NotSupported& error) {
        broken.push_back({std::string(system.name), error.what()});
      }
    }
    std::string reason = fmt::format("no device {}", device_id);
    for (const measure::Broken& each : broken) {
      reason += fmt::format("; {}: {}", each.what, each.reason);
    }
    throw core::NotSupported(reason);
  }

 private:
  // Returns whether the device can belong to this window system. Other window systems are skipped
  // when a device is opened, because their libraries must not be loaded.
  static bool may_provide(const WindowSystem& system, std::string_view device_id) {
    const bool osmesa = device_id.find("-osmesa") != std::string_view::npos;
    return osmesa == (system.suffix == "-osmesa");
  }
};

}  // namespace

std::unique_ptr<measure::Backend> make_backend() {
  return std::make_unique<GlBackend>();
}

}  // namespace triptych::gl_backend
