// The `view` command determines what to show, and then replaces this process with the program that
// opens the window.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "app/arguments.hpp"
#include "app/one_frame.hpp"
#include "app/paths.hpp"
#include "app/registry.hpp"
#include "core/json_text.hpp"
#include "core/output_files.hpp"
#include "measure/contract/factor.hpp"
#include "measure/protocol/injected_fault.hpp"
#include "measure/request/view_request.hpp"
#include "measure/system/environment.hpp"
#include "measure/worker/listing.hpp"
#include "measure/worker/own_program.hpp"

namespace triptych::app {
namespace {

namespace fs = std::filesystem;

struct ViewArguments {
  FrameArguments frame;
  std::vector<std::string> devices;
  int limit_s = default_limit_s;
  std::string size = "1280x720";
  std::string screenshot;
  bool json = false;
};

constexpr std::size_t max_columns = 4;

// Returns the path of the program that opens the window. Throws InputError if it was not built.
std::string window_program() {
  const fs::path program = fs::path(measure::own_program()).parent_path() / "triptych-view";
  if (::access(program.c_str(), X_OK) == 0) return program.string();
  throw core::InputError(fmt::format(
      "view: the program that opens the window, {}, is not installed. CMake builds it if "
      "the packages libglfw3-dev and libimgui-dev are installed (ci/setup --view). It "
      "is also part of the Debian package triptych-view",
      program.string()));
}

// Adds the devices that `text` selects. `text` is "GLOB" or "DEVICE,NAME=VALUE,…".
void add_sides(const measure::Listing& listing, const std::string& text,
               std::vector<measure::ViewSide>& sides) {
  const std::string glob = text.substr(0, text.find(','));
  std::vector<std::string> environment;
  if (glob.size() < text.size()) {
    environment = measure::parse_environment(text.substr(glob.size() + 1),
                                             "--device " + text + ": after the device");
  }
  for (std::string& device : measure::choose_devices(listing, {glob})) {
    sides.push_back({.device = std::move(device), .environment = environment});
  }
}

// Returns the first device of each API, but at most as many devices as the window has columns.
std::vector<measure::ViewSide> first_device_of_each_api(const measure::Listing& listing) {
  std::vector<measure::ViewSide> sides;
  std::vector<std::string> apis;
  for (const record::Device& device : listing.devices) {
    if (std::ranges::find(apis, device.api) != apis.end()) continue;
    apis.push_back(device.api);
    if (sides.size() < max_columns) sides.push_back({.device = device.id});
  }
  return sides;
}

std::vector<measure::ViewSide> sides_of(const ViewArguments& arguments,
                                        const measure::Listing& listing) {
  static_cast<void>(measure::choose_devices(listing, {}));  // throws if the list is empty
  if (arguments.devices.empty()) return first_device_of_each_api(listing);
  std::vector<measure::ViewSide> sides;
  for (const std::string& each : arguments.devices) add_sides(listing, each, sides);
  if (sides.size() > max_columns) {
    throw core::InputError(
        fmt::format("--device matches {} devices, but the window can show at most {}", sides.size(),
                    max_columns));
  }
  return sides;
}

// Replaces this process with the program that opens the window.
[[noreturn]] void exec_program(const std::string& program, const std::string& request) {
  std::string name = "triptych-view";
  std::string argument = request;
  char* const arguments[] = {name.data(), argument.data(), nullptr};
  ::execv(program.c_str(), arguments);
  throw core::IoError(fmt::format("cannot start {}: {}", program, std::strerror(errno)));
}

core::ExitCode view(const ViewArguments& arguments) {
  const Registry registry = make_registry();
  const auto [suite, plan] = choose_data(registry, arguments.frame);
  if (!plan.automatic.empty()) {
    throw core::InputError(
        "technique=auto cannot be used, because the window shows one technique at a time; name a "
        "technique");
  }
  for (const auto& each : measure::parse_faults(arguments.frame.faults)) {
    measure::check_fault(each.fault);
  }
  if (const auto reason = measure::reason_not_to_measure()) throw core::InputError(*reason);
  if (!arguments.screenshot.empty()) {
    core::require_writable(fs::absolute(arguments.screenshot).parent_path());
  }
  const auto [width, height] = measure::parse_viewport(arguments.size);
  const std::string program = window_program();
  measure::Listing listing = registry.devices({});
  measure::ViewRequest request{.program = measure::own_program(),
                               .suite = std::string(suite.name()),
                               .configuration = plan.configurations.front(),
                               .devices = {},
                               .sides = sides_of(arguments, listing),
                               .faults = arguments.frame.faults,
                               .limit_s = arguments.limit_s,
                               .width = width,
                               .height = height,
                               .screenshot = arguments.screenshot,
                               .json = arguments.json};
  request.devices = std::move(listing.devices);
  for (const fs::path& each : data_folders()) request.data_folders.push_back(each.string());
  exec_program(program, core::json_text(core::Json(request)));
}

}  // namespace

void add_view_command(Commands& commands) {
  auto [command, arguments] = commands.add(
      "view",
      "Show one configuration on several devices in a window, with a mouse-controlled camera", view,
      {.frame = {.allow_auto = true}});
  command.add_option("SUITE", arguments.frame.suite, "volume or particles")->required();
  command.add_option(
      "--device", arguments.devices,
      "Show a column for each device that matches this glob (repeatable; default: one "
      "device per API); DEVICE,NAME=VALUE,… sets environment variables for the "
      "driver, so that two drivers can be shown side by side");
  command.add_option("--set", arguments.frame.set,
                     "factor=level: set this factor to this level (repeatable); write a comma "
                     "inside a level as %2C");
  add_inject_option(command, arguments.frame.faults,
                    "Inject a fault (repeatable); see `triptych run --help`");
  add_limit_option(command, arguments.limit_s, "a frame");
  command.add_option("--size", arguments.size, "Size of the window in pixels")
      ->capture_default_str();
  command.add_option(
      "--screenshot", arguments.screenshot,
      "Wait until every device has drawn its image, save a screenshot of the window as a PNG "
      "image to this file, and exit");
  command.add_flag("--json", arguments.json,
                   "Print the displayed results as JSON when the window is closed");
  add_example(command,
              "triptych view volume --device vulkan:lavapipe --device gl:llvmpipe-egl "
              "--set transfer_function=surfaces");
}

}  // namespace triptych::app
