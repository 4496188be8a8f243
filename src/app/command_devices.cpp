#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "app/arguments.hpp"
#include "app/registry.hpp"
#include "app/terminal.hpp"
#include "measure/worker/listing.hpp"
#include "report/screen/columns.hpp"
#include "report/words/clocks.hpp"
#include "report/words/outcome.hpp"

namespace triptych::app {
namespace {

using measure::Greeting;
using report::words::text_of;

std::string why(const measure::Broken& broken) {
  return broken.ended ? text_of(*broken.ended) : broken.reason;
}

// `greeted` contains the devices that were opened, and `broken` the devices that cannot be used.
// `compilers` contains compile-only devices, which compile code for GPUs that this machine does not
// have. The driver was asked whether it supports their GPU families.
struct Devices {
  std::vector<Greeting> greeted;
  std::vector<measure::Broken> broken;
  measure::Listing compilers;
};

std::string usable(const Greeting& greeting) {
  if (greeting.refused) return "no: " + text_of(*greeting.refused);
  return greeting.device.compiles_for.empty() ? "yes" : "only to compile";
}

// Prints one line for each device: its id, its driver version, whether its clocks are trusted, and
// whether it can be used.
void print_table(const Devices& found) {
  std::vector<std::vector<std::string>> rows{{"device", "driver", "clock", "usable"}};
  for (const Greeting& each : found.greeted) {
    rows.push_back({core::printable(each.device.id), core::printable(each.device.driver_version),
                    report::words::trust_of(each.clocks), core::printable(usable(each))});
  }
  for (const measure::Broken& each : found.broken) {
    rows.push_back({core::printable(each.what), "–", "–", core::printable("no: " + why(each))});
  }
  print_lines(report::aligned_columns(rows) + "\n");
}

void print_text(const Devices& found) {
  print_table(found);
  for (const Greeting& each : found.greeted) {
    print_out("{}\n  {} ({}), driver {}, {}\n", each.device.id, each.device.name,
              each.device.vendor, each.device.driver_version, each.device.api_version);
    if (each.refused) print_out("  cannot be used: {}\n", text_of(*each.refused));
    if (!each.device.compiles_for.empty()) {
      print_out("  compiles code for the GPU family {} but cannot execute it\n",
                each.device.compiles_for);
    }
    for (const record::ClockTrust& clock : each.clocks) {
      print_out("  clock for {}: {}\n", clock.work, clock.verdict);
    }
    for (const auto& [statistic, verdict] : each.device.statistics_calibration) {
      print_out("  statistic {}: {}\n", statistic, text_of(verdict));
    }
    std::string limits;
    for (const auto& [name, value] : each.device.limits)
      limits += fmt::format(" {}={}", name, value);
    if (!limits.empty()) print_out("  limits:{}\n", limits);
    for (const auto& [name, value] : each.device.environment) {
      print_out("  environment: {}={}\n", name, value);
    }
  }
  for (const measure::Broken& each : found.broken) {
    print_out("{} cannot be used: {}\n", each.what, why(each));
  }
  if (found.compilers.devices.empty() && found.compilers.broken.empty()) return;
  print_out(
      "compilers for GPUs that are not in this machine (--compilers prints more about them):\n");
  for (const record::Device& each : found.compilers.devices) print_out("  {}\n", each.id);
  for (const measure::Broken& each : found.compilers.broken) {
    print_out("  {} cannot be used: {}\n", each.what, each.reason);
  }
}

void print_json(const Devices& found) {
  core::Json json{{"devices", core::Json::array()},
                  {"broken", core::Json::array()},
                  {"compilers", core::Json::array()}};
  for (const Greeting& each : found.greeted) {
    core::Json entry = each.device;
    entry["key"] = each.device.key();
    entry["clocks"] = each.clocks;
    if (each.refused) entry["refused"] = *each.refused;
    json["devices"].push_back(std::move(entry));
  }
  for (const record::Device& each : found.compilers.devices) json["compilers"].push_back(each.id);
  for (const auto* listed : {&found.broken, &found.compilers.broken}) {
    for (const measure::Broken& each : *listed) {
      json["broken"].push_back({{"what", each.what}, {"reason", why(each)}});
    }
  }
  print(json);
}

void keep_only(const std::vector<std::string>& ids, measure::Listing& listing) {
  std::erase_if(listing.devices, [&](const record::Device& device) {
    return std::ranges::find(ids, device.id) == ids.end();
  });
}

struct DevicesArguments {
  std::vector<std::string> devices;
  bool json = false;
  bool compilers = false;
};

core::ExitCode devices(const DevicesArguments& arguments) {
  const Registry registry = make_registry();
  measure::Listing listing = arguments.compilers ? registry.devices_and_compilers(arguments.devices)
                                                 : registry.devices(arguments.devices);
  if (!arguments.devices.empty())
    keep_only(measure::choose_devices(listing, arguments.devices), listing);
  const std::string suite(registry.suites.front()->name());
  Devices found{.greeted = {}, .broken = std::move(listing.broken), .compilers = {}};
  for (const record::Device& device : listing.devices) {
    found.greeted.push_back(measure::greet(device, suite));
  }
  const std::vector<std::string> compilers = measure::installed_compilers();
  if (!arguments.compilers && !compilers.empty()) {
    found.compilers = measure::list_compilers(compilers);
  }
  if (arguments.json) {
    print_json(found);
  } else {
    print_text(found);
  }
  return found.greeted.empty() ? core::ExitCode::cannot_judge : core::ExitCode::pass;
}

}  // namespace

void add_devices_command(Commands& commands) {
  auto [command, arguments] = commands.add(
      "devices", "List the devices, their limits, and which of their timers are trustworthy",
      devices);
  command.add_option("--device", arguments.devices,
                     "List only devices that match this glob (repeatable; default: all)");
  command.add_flag("--compilers", arguments.compilers,
                   "Also describe the compilers for GPUs that are not in this machine");
  command.add_flag("--json", arguments.json, "Print machine-readable JSON");
  add_example(command, "triptych devices --json");
}

}  // namespace triptych::app
