#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "app/compare_sides.hpp"
#include "app/registry.hpp"
#include "app/terminal.hpp"
#include "app/verdicts.hpp"
#include "comparison/side_by_side.hpp"
#include "comparison/store_diff.hpp"
#include "core/quoting.hpp"
#include "measure/request/error_answer.hpp"
#include "measure/system/environment.hpp"
#include "measure/worker/own_program.hpp"
#include "report/exports/comparison_json.hpp"
#include "report/screen/comparison_screen.hpp"
#include "report/screen/device_table.hpp"

namespace triptych::app {
namespace {

struct CompareArguments {
  ComparisonRequest request;
  std::string a;
  std::string b;
  std::string a_program;
  std::string b_program;
  bool no_times = false;
  bool apis = false;
  bool json = false;
};

// Parses "DEVICE,NAME=VALUE,…".
measure::SideOptions parse_side(std::string_view option, const std::string& text,
                                const std::string& program) {
  const std::string where = fmt::format("{} {}", option, text);
  measure::SideOptions side{.device = text.substr(0, text.find(',')), .command = {}};
  if (side.device.find(':') == std::string::npos) {
    throw core::InputError(
        where +
        ": expected a device such as vulkan:lavapipe; `triptych devices` lists the devices");
  }
  if (side.device.size() < text.size()) {
    const std::string_view after = std::string_view(text).substr(side.device.size() + 1);
    side.environment = measure::parse_environment(after, where + ": after the device");
  }
  side.command = program.empty() ? measure::worker_command()
                                 : worker_of(fmt::format("{}-program", option), program);
  return side;
}

// Returns, for each device of the plan, the records of the latest run that contains the device.
// They are followed by the records of earlier runs with the same device, driver version and
// program, which show how much the results vary between worker processes. A device may be missing
// from the latest run, because `compare --store` writes a separate run for each side.
std::vector<record::Record> records_of_all_devices(const record::Store& store,
                                                   const record::Run& latest) {
  const auto program = [](const record::Run& run) {
    const auto found = run.system.find("triptych");
    return found == run.system.end() ? std::string() : found->second;
  };
  std::vector<record::Record> records;
  std::map<std::string, std::pair<std::string, std::string>> setups;  // device key and program
  std::vector<record::Run> runs = store.runs();
  std::ranges::reverse(runs);
  for (const record::Run& run : runs) {
    if (run.plan != latest.plan || run.plan_hash != latest.plan_hash) continue;
    std::set<std::string> devices;
    for (const auto& entry : store.devices(run.id)) {
      const std::pair setup{entry.device.key(), program(run)};
      const auto& first = setups.try_emplace(entry.device.id, setup).first->second;
      if (setup == first) devices.insert(entry.device.id);
    }
    for (record::Record& record : store.records(run.id)) {
      if (devices.contains(record.device)) records.push_back(std::move(record));
    }
  }
  return records;
}

// Returns the records to be compared. If the run searched settings for a requested error
// (`run --error`), these are only the answers, because the other records are candidates that would
// not be used.
std::vector<record::Record> records_to_compare(const record::Run& run,
                                               std::vector<record::Record> records,
                                               const Registry& registry, measure::Truths& truths) {
  const auto searched = std::ranges::find_if(
      run.begun, [](const record::RunStart& each) { return !each.requested_error.empty(); });
  if (searched == run.begun.end() || records.empty()) return records;
  const measure::ErrorGoal goal = measure::error_goal(
      searched->requested_error, {searched->fixed.begin(), searched->fixed.end()});
  return measure::answer_records(
      measure::answer_error(records, registry.suite(records.front().suite), goal, truths));
}

// Prints, for the latest run of each plan, a table that compares all devices with each other.
core::ExitCode print_api_table(const CompareArguments& arguments) {
  const ComparisonRequest& request = arguments.request;
  if (request.store.empty()) {
    throw core::InputError("--apis needs --store FILE; create the store with `triptych run`");
  }
  record::Store store = open_to_judge(request.store);
  const Registry registry = make_registry();
  measure::Truths truths(registry.find_suite(), store);
  std::set<std::string> requested_runs;
  for (const std::string& plan : request.plans) {
    requested_runs.insert(latest_run_of(store, plan, request.store));
  }
  core::Json json = core::Json::object();
  for (const record::Run& run : latest_runs(store)) {
    if (!requested_runs.empty() && !requested_runs.contains(run.id)) continue;
    const auto table = comparison::side_by_side(
        records_to_compare(run, records_of_all_devices(store, run), registry, truths));
    if (!table) continue;
    json[run.plan] = report::to_json(*table);
    if (!arguments.json)
      print_lines(fmt::format("{}\n\n{}\n", run.plan, report::screen_of(*table)));
  }
  if (json.empty()) {
    throw core::NotSupported(request.store +
                             ": no configuration was measured on more than one device");
  }
  if (arguments.json) print(json);
  return core::ExitCode::pass;
}

core::ExitCode compare(const CompareArguments& arguments) {
  if (arguments.apis) return print_api_table(arguments);
  if (arguments.a.empty() || arguments.b.empty()) {
    throw core::InputError("compare needs either two sides (--a and --b) or --apis with --store");
  }
  ComparisonRequest request = arguments.request;
  request.a = parse_side("--a", arguments.a, arguments.a_program);
  request.b = parse_side("--b", arguments.b, arguments.b_program);
  request.times = !arguments.no_times;
  for (const auto& [option, value] : {std::pair{"--a", arguments.a},
                                      {"--b", arguments.b},
                                      {"--a-program", arguments.a_program},
                                      {"--b-program", arguments.b_program}}) {
    if (value.empty()) continue;
    const char* const space = request.sides.empty() ? "" : " ";
    request.sides += fmt::format("{}{} {}", space, option, core::shell_quoted(value));
  }
  return compare_and_print({request}, arguments.json);
}

struct DiffArguments {
  std::string a;
  std::string b;
  std::vector<std::string> devices;
  bool verbose = false;
  bool json = false;
};

core::ExitCode diff(const DiffArguments& arguments) {
  const Registry registry = make_registry();
  const record::Store a = open_to_judge(arguments.a);
  record::Store b = open_to_judge(arguments.b);
  measure::Truths truths(registry.find_suite(), b);
  const comparison::StoreDiff found = comparison::diff_stores(a, b, arguments.devices, truths);
  if (found.devices.empty() && found.one_sided.empty()) {
    throw core::NotSupported(fmt::format("neither {} nor {} contains a run{}", arguments.a,
                                         arguments.b,
                                         arguments.devices.empty() ? "" : " on a matching device"));
  }
  if (arguments.json) {
    print(report::to_json(found));
  } else {
    print_lines(report::screen_of(found, arguments.verbose));
  }
  return found.exit_code();
}

void add_diff_command(Commands& commands) {
  auto [command, arguments] = commands.add(
      "diff", "List the differences between two stores, for example from two driver versions",
      diff);
  add_example(command, "triptych diff old.sqlite new.sqlite");
  command.add_option("OLD", arguments.a, "Store written by `triptych run` or `triptych validate`")
      ->required();
  command
      .add_option("NEW", arguments.b, "Store to compare with OLD; it must contain the same plans")
      ->required();
  add_devices_option(command, arguments.devices);
  command.add_flag("--verbose", arguments.verbose,
                   "List every configuration with a difference, the largest differences first");
  command.add_flag("--json", arguments.json, "Print machine-readable JSON");
}

}  // namespace

void add_compare_commands(Commands& commands) {
  add_diff_command(commands);
  auto [command, arguments] = commands.add("compare",
                                           "Compare the deterministic measurements and the frame "
                                           "times of two devices, drivers or builds",
                                           compare);
  add_example(command, "triptych compare volume/quick --a gl:llvmpipe-egl --b vulkan:lavapipe");
  ComparisonRequest& request = arguments.request;
  command.add_option("PLAN", request.plans,
                     fmt::format("Plans to compare: YAML files, or SUITE/PLAN (default: {})",
                                 fmt::join(default_plans, " ")));
  add_choice_options(command, request.choice);
  constexpr const char* side =
      "DEVICE[,NAME=VALUE]…: the device to measure on this side, and environment variables to set "
      "for this side only";
  command.add_option("--a", arguments.a, side);
  command.add_option("--b", arguments.b, side);
  command.add_option("--a-program", arguments.a_program,
                     "Measure side a with the triptych executable at this path");
  command.add_option("--b-program", arguments.b_program,
                     "Measure side b with the triptych executable at this path");
  command.add_flag("--no-times", arguments.no_times,
                   "Compare only deterministic measurements, not frame times");
  command.add_flag("--apis", arguments.apis,
                   "Do not measure; print a table that compares the devices in --store, with one "
                   "row per technique");
  command
      .add_option("--budget", request.budget_s,
                  "Stop measuring frame times after this many seconds (default: no limit)")
      ->check(CLI::Range(1, 1000000));
  add_limit_option(command, request.limit_s, "a worker that does not respond");
  command.add_option("--store", request.store,
                     "Save both runs in this SQLite file (default: do not save them)");
  command.add_option("--seed", request.seed, "Seed for the random order of the measurements")
      ->capture_default_str();
  add_inject_option(command, request.faults,
                    "Inject a fault into side b to check that the comparison detects it; see "
                    "`triptych run --help`");
  command.add_flag("--verbose", request.verbose,
                   "Print one line for each measured configuration, and list every configuration "
                   "with a difference or an undecided time");
  command.add_flag("--json", arguments.json, "Print machine-readable JSON");
}

}  // namespace triptych::app
