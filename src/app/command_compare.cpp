#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "app/comparing.hpp"
#include "app/judging.hpp"
#include "app/registry.hpp"
#include "comparison/side_by_side.hpp"
#include "comparison/store_diff.hpp"
#include "core/quoting.hpp"
#include "measure/system/environment.hpp"
#include "measure/worker/own_program.hpp"

namespace triptych::app {
namespace {

struct CompareArguments {
  Comparing comparing;
  std::string a;
  std::string b;
  std::string a_program;
  std::string b_program;
  bool no_times = false;
  bool apis = false;
  bool json = false;
};

// "DEVICE,NAME=VALUE,…"
measure::SideOptions parse_side(std::string_view option, const std::string& text,
                                const std::string& program) {
  const std::string where = fmt::format("{} {}", option, text);
  measure::SideOptions side{.device = text.substr(0, text.find(',')), .command = {}};
  if (side.device.find(':') == std::string::npos) {
    throw core::InputError(
        where + ": expected a device such as vulkan:lavapipe, `triptych devices` lists them");
  }
  if (side.device.size() < text.size()) {
    const std::string_view after = std::string_view(text).substr(side.device.size() + 1);
    side.environment = measure::parse_environment(after, where + ": after the device");
  }
  side.command = program.empty() ? measure::worker_command()
                                 : worker_of(fmt::format("{}-program", option), program);
  return side;
}

// Of the latest run of each plan: what it measured, device beside device.
core::ExitCode show_apis(const CompareArguments& arguments) {
  const Comparing& comparing = arguments.comparing;
  if (comparing.store.empty()) {
    throw core::InputError("--apis needs --store: the file that `triptych run` wrote");
  }
  const record::Store store = open_to_judge(comparing.store);
  std::set<std::string> asked;
  for (const std::string& plan : comparing.plans) {
    asked.insert(latest_run_of(store, plan, comparing.store));
  }
  core::Json json = core::Json::object();
  for (const record::Run& run : latest_runs(store)) {
    if (!asked.empty() && !asked.contains(run.id)) continue;
    const auto table = comparison::side_by_side(store.records(run.id));
    if (!table) continue;
    json[run.plan] = comparison::to_json(*table);
    if (!arguments.json) fmt::print("{}\n\n{}\n", run.plan, comparison::to_text(*table));
  }
  if (json.empty()) {
    throw core::NotSupported(comparing.store + ": no two devices measured the same configuration");
  }
  if (arguments.json) print(json);
  return core::ExitCode::pass;
}

core::ExitCode compare(const CompareArguments& arguments) {
  if (arguments.apis) return show_apis(arguments);
  if (arguments.a.empty() || arguments.b.empty()) {
    throw core::InputError("compare needs two sides, --a and --b, or --apis with a store");
  }
  Comparing comparing = arguments.comparing;
  comparing.a = parse_side("--a", arguments.a, arguments.a_program);
  comparing.b = parse_side("--b", arguments.b, arguments.b_program);
  comparing.times = !arguments.no_times;
  for (const auto& [option, value] : {std::pair{"--a", arguments.a},
                                      {"--b", arguments.b},
                                      {"--a-program", arguments.a_program},
                                      {"--b-program", arguments.b_program}}) {
    if (value.empty()) continue;
    const char* const space = comparing.sides.empty() ? "" : " ";
    comparing.sides += fmt::format("{}{} {}", space, option, core::shell_quoted(value));
  }
  return compare_and_tell({comparing}, arguments.json);
}

struct DiffArguments {
  std::string a;
  std::string b;
  std::vector<std::string> devices;
  bool json = false;
};

core::ExitCode diff(const DiffArguments& arguments) {
  const Registry registry = make_registry();
  const record::Store a = open_to_judge(arguments.a);
  record::Store b = open_to_judge(arguments.b);
  measure::Truths truths(registry.find_suite(), b);
  const comparison::StoreDiff found = comparison::diff_stores(a, b, arguments.devices, truths);
  if (found.devices.empty() && found.only_one.empty()) {
    throw core::NotSupported(fmt::format("{} and {} hold no run{}", arguments.a, arguments.b,
                                         arguments.devices.empty() ? "" : " of such a device"));
  }
  if (arguments.json) {
    print(comparison::to_json(found));
  } else {
    fmt::print("{}", comparison::to_text(found));
  }
  return found.exit_code();
}

void add_diff_command(Commands& commands) {
  auto [command, arguments] = commands.add(
      "diff", "Say what differs between two stores, of a driver and the next, say", diff);
  command.add_option("OLD", arguments.a, "Store of a run or a validation")->required();
  command.add_option("NEW", arguments.b, "Store of the same plans")->required();
  add_devices_option(command, arguments.devices);
  command.add_flag("--json", arguments.json, "Print everything as JSON");
}

}  // namespace

void add_compare_commands(Commands& commands) {
  add_diff_command(commands);
  auto [command, arguments] = commands.add(
      "compare", "Say what differs between two devices, drivers or builds, times last", compare);
  Comparing& comparing = arguments.comparing;
  command.add_option(
      "PLAN", comparing.plans,
      fmt::format("YAML files, or SUITE/PLAN (default: {})", fmt::join(main_job, " ")));
  add_choice_options(command, comparing.choice);
  constexpr const char* side = "DEVICE[,NAME=VALUE]…: with variables set for this side alone";
  command.add_option("--a", arguments.a, side);
  command.add_option("--b", arguments.b, side);
  command.add_option("--a-program", arguments.a_program, "Another build of triptych to measure a");
  command.add_option("--b-program", arguments.b_program, "Another build of triptych to measure b");
  command.add_flag("--no-times", arguments.no_times, "Only what repeats");
  command.add_flag("--apis", arguments.apis,
                   "Show what --store holds, technique by technique and device beside device");
  command
      .add_option("--budget", comparing.budget_s,
                  "Seconds after which no doubt about a time is followed any further (default: "
                  "none)")
      ->check(CLI::Range(1, 1000000));
  add_limit_option(command, comparing.limit_s, "one answer");
  command.add_option("--store", comparing.store,
                     "SQLite file that keeps both runs (default: nothing is kept)");
  command.add_option("--seed", comparing.seed, "Of the order in which times are taken")
      ->capture_default_str();
  add_inject_option(command, comparing.faults,
                    "Inject a fault into side b, to prove that it is found; as for run");
  command.add_flag("--json", arguments.json, "Print everything as JSON");
}

}  // namespace triptych::app
