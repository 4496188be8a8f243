#include <fmt/format.h>

#include <utility>

#include "app/arguments.hpp"
#include "app/registry.hpp"
#include "app/terminal.hpp"
#include "measure/worker/listing.hpp"
#include "report/words/outcome.hpp"

namespace triptych::app {
namespace {

using measure::Greeting;
using report::words::text_of;

std::string why(const measure::Broken& broken) {
  return broken.ended ? text_of(*broken.ended) : broken.reason;
}

void print_text(const std::vector<Greeting>& greeted, const std::vector<measure::Broken>& broken) {
  for (const Greeting& each : greeted) {
    put("{}\n  {} ({}), driver {}, {}\n", each.device.id, each.device.name, each.device.vendor,
        each.device.driver_version, each.device.api_version);
    if (each.refused) put("  cannot be used: {}\n", text_of(*each.refused));
    if (!each.device.compiles_for.empty()) {
      put("  only compiles, for the GPU family {}: nothing is executed on it\n",
          each.device.compiles_for);
    }
    for (const record::ClockTrust& clock : each.clocks) {
      put("  clock for {}: {}\n", clock.work, clock.verdict);
    }
    for (const auto& [statistic, verdict] : each.device.statistics_calibration) {
      put("  statistic {}: {}\n", statistic, text_of(verdict));
    }
    std::string limits;
    for (const auto& [name, value] : each.device.limits)
      limits += fmt::format(" {}={}", name, value);
    if (!limits.empty()) put("  limits:{}\n", limits);
    for (const auto& [name, value] : each.device.environment) {
      put("  environment: {}={}\n", name, value);
    }
  }
  for (const measure::Broken& each : broken) put("not usable: {}: {}\n", each.what, why(each));
}

void print_json(const std::vector<Greeting>& greeted, const std::vector<measure::Broken>& broken) {
  core::Json json{{"devices", core::Json::array()}, {"broken", core::Json::array()}};
  for (const Greeting& each : greeted) {
    core::Json entry = each.device;
    entry["key"] = each.device.key();
    entry["clocks"] = each.clocks;
    if (each.refused) entry["refused"] = *each.refused;
    json["devices"].push_back(std::move(entry));
  }
  for (const measure::Broken& each : broken) {
    json["broken"].push_back({{"what", each.what}, {"reason", why(each)}});
  }
  print(json);
}

core::ExitCode devices(const bool& json) {
  const Registry registry = make_registry();
  const measure::Listing listing = registry.devices_and_compilers({});
  const std::string suite(registry.suites.front()->name());
  std::vector<Greeting> greeted;
  for (const record::Device& device : listing.devices)
    greeted.push_back(measure::greet(device, suite));
  if (json) {
    print_json(greeted, listing.broken);
  } else {
    print_text(greeted, listing.broken);
  }
  return greeted.empty() ? core::ExitCode::cannot_judge : core::ExitCode::pass;
}

}  // namespace

void add_devices_command(Commands& commands) {
  auto [command, json] = commands.add(
      "devices", "List the devices, what they can do, and which of their timers are trustworthy",
      devices);
  command.add_flag("--json", json, "Print machine-readable JSON");
  add_example(command, "triptych devices --json");
}

}  // namespace triptych::app
