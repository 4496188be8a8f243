#include <string>
#include <vector>

#include "app/arguments.hpp"
#include "app/feature_table.hpp"
#include "app/registry.hpp"
#include "app/terminal.hpp"
#include "measure/worker/listing.hpp"

namespace triptych::app {
namespace {

struct FeatureArguments {
  std::vector<std::string> devices;
  std::string only;
  int limit_s = default_limit_s;
  bool json = false;
};

core::ExitCode features(const FeatureArguments& arguments) {
  const measure::Listing listing = make_registry().devices(arguments.devices);
  const FeatureTable table = probe_devices(measure::choose_devices(listing, arguments.devices),
                                           arguments.only, arguments.limit_s);
  if (arguments.json) {
    print(feature_json(table));
  } else {
    print_lines(feature_text(table));
  }
  return verdict_of(table);
}

core::ExitCode answer(const std::string& device) {
  measure::answer_features(make_registry().backend(device.substr(0, device.find(':'))), device);
  return core::ExitCode::pass;
}

}  // namespace

void add_features_command(Commands& commands) {
  auto [command, arguments] =
      commands.add("features",
                   "Check API features that no scene uses, such as large buffer offsets, large "
                   "numbers of draws, and sampling modes",
                   features);
  command.add_option("--device", arguments.devices,
                     "Check only devices that match this glob (repeatable; default: all)");
  command.add_option("--only", arguments.only, "Check only the feature with this name");
  add_limit_option(command, arguments.limit_s, "a feature probe");
  command.add_flag("--json", arguments.json, "Print machine-readable JSON");
  add_example(command, "triptych features --device 'vulkan:*'");

  auto [probing, device] =
      commands.add("probe-features", "Probe features in a separate process", answer);
  probing.add_option("DEVICE", device)->required();
  probing.group("");
}

}  // namespace triptych::app
