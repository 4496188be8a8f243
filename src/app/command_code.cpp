// The `code` command prints the statistics and the disassembly that a device's compiler produces
// for one configuration.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "app/arguments.hpp"
#include "app/one_frame.hpp"
#include "app/paths.hpp"
#include "app/registry.hpp"
#include "app/terminal.hpp"
#include "core/quoting.hpp"
#include "core/temporary_folder.hpp"
#include "judge/baselines/baselines.hpp"
#include "judge/code/code_change.hpp"
#include "measure/plan/plan.hpp"
#include "measure/run/runner.hpp"
#include "measure/worker/listing.hpp"
#include "measure/worker/own_program.hpp"
#include "record/store.hpp"

namespace triptych::app {
namespace {

struct CodeArguments {
  FrameArguments frame;
  std::string stored;  // a plan; empty: SUITE/code
  std::string baselines = default_baselines().string();
  bool brief = false;
  bool json = false;
  int limit_s = default_limit_s;
};

// The compiled code of one configuration, and the stored statistics of the same driver version.
struct CompiledCode {
  record::Device device;
  record::Record record;
  record::Code stored;  // empty if nothing is stored
};

record::Code stored_code(const CodeArguments& arguments, const record::Device& device,
                         const std::string& configuration) {
  const std::string plan =
      arguments.stored.empty() ? arguments.frame.suite + "/code" : arguments.stored;
  const judge::Baselines baselines(arguments.baselines, plan);
  const judge::DriverCode* driver = baselines.present() ? baselines.code(device) : nullptr;
  if (driver != nullptr) {
    const auto found = driver->configurations.find(configuration);
    if (found != driver->configurations.end()) return found->second;
  }
  if (!arguments.stored.empty()) {
    print_err("the baselines of {} contain no statistics of this configuration for {}, driver {}\n",
              plan, device.id, device.driver_version);
  }
  return {};
}

std::string statistic_text(std::optional<double> value) {
  return value ? fmt::format("{:g}", *value) : std::string("–");
}

std::optional<double> statistic_in(const std::map<std::string, double>& statistics,
                                   const std::string& name) {
  const auto found = statistics.find(name);
  return found == statistics.end() ? std::nullopt : std::optional(found->second);
}

// Prints lines such as " Inverse Throughput 6486", the most important statistics first. If there
// are stored statistics, prints them in front of the new ones, and marks each statistic that
// differs. `samples` is true if the executable may contain a loop that samples a volume.
void print_statistics(const record::Executable& executable, const record::Executable* stored,
                      bool samples) {
  std::set<std::string> all;
  for (const auto& [name, value] : executable.statistics) all.insert(name);
  if (stored != nullptr) {
    for (const auto& [name, value] : stored->statistics) all.insert(name);
    print_out("  {:<28} {:>10} {:>10}\n", "", "stored", "now");
  }
  std::vector<std::string> names(all.begin(), all.end());
  std::ranges::stable_sort(names, {}, [](const std::string& name) {
    return std::tuple(judge::code_statistic(name).rank, std::string_view(name));
  });
  for (const std::string& name : names) {
    const std::optional<double> now = statistic_in(executable.statistics, name);
    if (stored == nullptr) {
      print_out("  {:<28} {}\n", name, statistic_text(now));
      continue;
    }
    const std::optional<double> before = statistic_in(stored->statistics, name);
    const bool both = before && now && *before > 0;
    print_out("  {:<28} {:>10} {:>10}{}{}\n", name, statistic_text(before), statistic_text(now),
              before == now ? "" : "  changed",
              both && *now != *before ? fmt::format(" ({:+.3g} %)", 100 * (*now / *before - 1))
                                      : std::string());
  }
  const bool disassembled = !executable.assembly.empty();
  if (samples && disassembled && !executable.statistics.contains("Loop instructions")) {
    print_out(
        "  the sampling loop could not be identified, so the number of instructions per iteration "
        "is not reported\n");
  }
}

void print_text(const CompiledCode& compiled, const record::Store& store, bool brief) {
  const record::Record& record = compiled.record;
  print_device(compiled.device);
  print_out("{}\n", record.configuration);
  for (const auto& [name, executable] : record.code) {
    print_out("\n{}\n", name);
    const auto stored = compiled.stored.find(name);
    print_statistics(executable, stored == compiled.stored.end() ? nullptr : &stored->second,
                     record.suite == "volume" && !name.ends_with(".vert"));
    if (brief || executable.assembly.empty()) continue;
    print_lines("\n" + store.listing(executable.assembly).value_or("") + "\n");
  }
  for (const auto& [name, executable] : compiled.stored) {
    if (!record.code.contains(name)) print_out("\n{}: stored, but no longer compiled\n", name);
  }
}

void print_json(const CompiledCode& compiled, const record::Store& store, bool brief) {
  const record::Record& record = compiled.record;
  core::Json json{{"device", compiled.device},
                  {"configuration", record.configuration},
                  {"code", record.code},
                  {"stored", compiled.stored}};
  if (!brief) {
    for (const auto& [name, executable] : record.code) {
      if (const auto text = store.listing(executable.assembly)) json["disassembly"][name] = *text;
    }
  }
  print(json);
}

measure::Plan plan_of(const measure::Suite& suite, const CodeArguments& arguments) {
  measure::Plan plan =
      measure::default_plan(suite, PlanChoice{.set = arguments.frame.set}.overrides());
  if (!plan.varied.empty()) {
    throw core::InputError("`code` compiles a single configuration; set each factor to one level");
  }
  plan.checks = {record::Check::code};
  return plan;
}

core::ExitCode code(const CodeArguments& arguments) {
  const Registry registry = make_registry();
  if (arguments.frame.device.empty()) registry.refuse_missing_device();
  measure::SuiteWithTruth& suite = registry.suite(arguments.frame.suite);
  const measure::Plan plan = plan_of(suite, arguments);
  const std::string device = measure::choose_device(
      registry.devices_and_compilers({arguments.frame.device}), "--device", arguments.frame.device);
  const core::TemporaryFolder folder;
  record::Store store(folder.path() / "code.sqlite", record::Store::Mode::append);
  const measure::RunResult result =
      measure::run_plan(plan, {device}, suite, store,
                        {.protocol = {},
                         .limit = std::chrono::seconds(arguments.limit_s),
                         .faults = measure::parse_faults(arguments.frame.faults),
                         .worker_command = measure::worker_command()},
                        {});
  const record::Record record = store.records(result.run).at(0);
  if (record.outcome != record::Outcome::measured) {
    throw record::NotMeasured(record.outcome, record.reason);
  }
  const record::Device device_info = store.devices(result.run).at(0).device;
  const CompiledCode compiled{device_info, record,
                              stored_code(arguments, device_info, record.configuration)};
  (arguments.json ? print_json : print_text)(compiled, store, arguments.brief);
  return core::ExitCode::pass;
}

}  // namespace

void add_code_command(Commands& commands) {
  auto [command, arguments] = commands.add(
      "code", "Print the compiler's statistics and the disassembly for one configuration", code);
  add_example(command, "triptych code volume --device vulkan:radv-navi21 --set shading=gradient");
  arguments.frame.add_to(command);
  command.add_flag("--brief", arguments.brief, "Print the statistics without the disassembly");
  command.add_option("--stored", arguments.stored,
                     "Print the statistics that the baselines of this plan contain next to the new "
                     "ones (default: SUITE/code, if it contains this configuration)");
  add_baselines_option(command, arguments.baselines);
  command.add_flag("--json", arguments.json, "Print JSON");
  add_limit_option(command, arguments.limit_s, "the compilation");
}

}  // namespace triptych::app
