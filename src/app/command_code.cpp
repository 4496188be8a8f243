// The `code` command prints the statistics and the disassembly that a device's compiler produces
// for one configuration.

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "app/arguments.hpp"
#include "app/one_frame.hpp"
#include "app/registry.hpp"
#include "app/terminal.hpp"
#include "core/quoting.hpp"
#include "core/temporary_folder.hpp"
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
  bool brief = false;
  bool json = false;
  int limit_s = default_limit_s;
};

// Prints lines such as " Inverse Throughput 6486", the most important statistics first. `samples`
// is true if the executable may contain a loop that samples a volume.
void print_statistics(const record::Executable& executable, bool samples) {
  std::vector<std::pair<std::string, double>> statistics(executable.statistics.begin(),
                                                         executable.statistics.end());
  std::ranges::stable_sort(statistics, {}, [](const auto& each) {
    return std::tuple(judge::code_statistic(each.first).rank, std::string_view(each.first));
  });
  for (const auto& [name, value] : statistics) {
    print_out("  {:<28} {:g}\n", name, value);
  }
  const bool disassembled = !executable.assembly.empty();
  if (samples && disassembled && !executable.statistics.contains("Loop instructions")) {
    print_out(
        "  the sampling loop could not be identified, so the number of instructions per iteration "
        "is not reported\n");
  }
}

void print_text(const record::Device& device, const record::Record& record,
                const record::Store& store, bool brief) {
  print_out("{}: {}, driver {}{}\n", device.id, device.name, device.driver_version,
            device.compiles_for.empty() ? "" : "; compiles code but cannot execute it");
  print_out("{}\n", record.configuration);
  for (const auto& [name, executable] : record.code) {
    print_out("\n{}\n", name);
    print_statistics(executable, record.suite == "volume" && !name.ends_with(".vert"));
    if (brief || executable.assembly.empty()) continue;
    print_lines("\n" + store.listing(executable.assembly).value_or("") + "\n");
  }
}

void print_json(const record::Device& device, const record::Record& record,
                const record::Store& store, bool brief) {
  core::Json json{
      {"device", device}, {"configuration", record.configuration}, {"code", record.code}};
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
  const record::Device described = store.devices(result.run).at(0).device;
  (arguments.json ? print_json : print_text)(described, record, store, arguments.brief);
  return core::ExitCode::pass;
}

}  // namespace

void add_code_command(Commands& commands) {
  auto [command, arguments] = commands.add(
      "code", "Print the compiler's statistics and the disassembly for one configuration", code);
  add_example(command, "triptych code volume --device vulkan:radv-navi31 --set shading=gradient");
  arguments.frame.add_to(command);
  command.add_flag("--brief", arguments.brief, "Print the statistics without the disassembly");
  command.add_flag("--json", arguments.json, "Print JSON");
  add_limit_option(command, arguments.limit_s, "the compilation");
}

}  // namespace triptych::app
