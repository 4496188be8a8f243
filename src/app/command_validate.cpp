#include <fmt/format.h>

#include <array>
#include <memory>
#include <set>

#include "app/arguments.hpp"
#include "app/judging.hpp"
#include "app/measuring.hpp"
#include "app/paths.hpp"
#include "app/registry.hpp"

namespace triptych::app {
namespace {

// What a driver must get right, whatever its speed: ordinary scenes by every technique, hostile
// ones, closed forms.
constexpr std::array<const char*, 6> plans{"volume/quick",     "volume/stress",
                                           "volume/accuracy",  "particles/quick",
                                           "particles/stress", "particles/accuracy"};

struct ValidateArguments {
  std::vector<std::string> devices;
  std::string out = "validation";
  std::string baselines = default_baselines().string();
  bool resume = false;
};

// Times, bits and statistics are a device's own; what is asked of any device is the right picture
// from the right amount of work. A stress case's score holds what its picture is worth.
record::Checks checks_of(const record::Checks& of_plan) {
  const bool scored = of_plan.contains(judge::Check::stress);
  return {scored ? judge::Check::stress : judge::Check::image, judge::Check::counters};
}

void print_devices(const record::Store& store, const std::string& run) {
  for (const auto& [device, clocks] : store.devices(run)) {
    fmt::print("{}\n  {} {}, API {}\n", device.id, device.driver, device.driver_version,
               device.api_version);
    for (const record::ClockTrust& clock : clocks) {
      fmt::print("  clock of {}: {}\n", clock.work, clock.verdict);
    }
    for (const auto& [statistic, verdict] : device.statistics_dialect) {
      fmt::print("  {}: {}\n", statistic, verdict);
    }
  }
}

core::ExitCode validate(const ValidateArguments& arguments) {
  require_writable(arguments.out);
  const std::string file = (std::filesystem::path(arguments.out) / "validation.sqlite").string();
  Measuring measuring;
  measuring.plans = {plans.begin(), plans.end()};
  measuring.devices = arguments.devices;
  measuring.store = file;
  measuring.resume = arguments.resume;
  const std::vector<int> told = measure_plans(measuring);
  for (std::size_t i = 0; i < plans.size(); ++i) {
    if (told[i] > 0) continue;
    throw core::NotSupported(fmt::format("{}: the devices asked for can do none of it", plans[i]));
  }
  const Registry registry = make_registry();
  record::Store store(file, record::Store::Mode::append);
  Truths truths(registry, store);
  core::ExitCode worst = core::ExitCode::pass;
  for (const char* plan : plans) {
    const std::string run = latest_run_of(store, plan, file);
    judge::GateRequest request = request_of(truths, plan);
    request.checks = checks_of(measure::load_plan(plan, {}, registry.find_suite()).checks);
    const judge::GateResult result =
        judge::judge_run(store, run, judge::Baselines(arguments.baselines, plan), request);
    fmt::print("\n{}\n{}", plan, text_of(result));
    worst = worse_of(worst, result.exit_code());
  }
  fmt::print("\n");
  print_devices(store, latest_run_of(store, plans.front(), file));
  const std::string page = (std::filesystem::path(arguments.out) / "report.html").string();
  write_text(page, page_of(store, truths, arguments.baselines));
  fmt::print("\nreport: {}\n", page);
  return worst;
}

}  // namespace

void add_validate_command(Commands& commands) {
  auto arguments = std::make_shared<ValidateArguments>();
  CLI::App* command =
      commands.add("validate", "Everything a new driver must pass: pictures, work, hostile scenes",
                   [arguments] { return validate(*arguments); });
  command->add_option("--device", arguments->devices, "Glob over device ids (repeatable)")
      ->required();
  command->add_option("--out", arguments->out, "Folder for the store and the report")
      ->capture_default_str();
  command->add_flag(
      "--resume", arguments->resume,
      "Go on with what is in the folder's store, after a kill or a crash of the machine");
  add_baselines_option(*command, arguments->baselines);
}

}  // namespace triptych::app
