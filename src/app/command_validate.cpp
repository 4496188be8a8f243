#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>

#include "app/arguments.hpp"
#include "app/judging.hpp"
#include "app/measuring.hpp"
#include "app/paths.hpp"
#include "app/registry.hpp"
#include "app/saying.hpp"
#include "measure/run/runner.hpp"
#include "measure/system/stopwatch.hpp"

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
  std::string junit;
  std::string json;
  bool resume = false;
};

// Times, bits and statistics are a device's own; what is asked of any device is the right picture
// from the right amount of work. A stress case's score holds what its picture is worth.
record::Checks checks_of(const record::Checks& of_plan) {
  const bool scored = of_plan.contains(judge::Check::stress);
  return {scored ? judge::Check::stress : judge::Check::image, judge::Check::counters};
}

// What a run that was interrupted has measured is judged like all else.
void measure_what_is_left(const ValidateArguments& arguments, const std::string& file) {
  try {
    measure_plans({.plans = {plans.begin(), plans.end()},
                   .devices = arguments.devices,
                   .store = file,
                   .resume = arguments.resume,
                   .untimed = true});
  } catch (const measure::Interrupted& interrupted) {
    say("triptych: {}\n", interrupted.what());
  }
}

// Runs of an earlier validation, which this one does not go on with.
std::set<std::string> runs_before(const ValidateArguments& arguments, const std::string& file) {
  std::set<std::string> ids;
  if (arguments.resume || !std::filesystem::exists(file)) return ids;
  for (const record::Run& run : record::Store(file, record::Store::Mode::read).runs()) {
    ids.insert(run.id);
  }
  return ids;
}

core::ExitCode validate(const ValidateArguments& arguments) {
  const measure::Stopwatch since;
  refuse_overwriting({}, {{"--junit", arguments.junit}, {"--json", arguments.json}});
  require_writable(arguments.out);
  const std::string file = (std::filesystem::path(arguments.out) / "validation.sqlite").string();
  const std::set<std::string> before = runs_before(arguments, file);
  measure_what_is_left(arguments, file);
  const Registry registry = make_registry();
  record::Store store = open_to_judge(file);
  Truths truths(registry, store);
  std::vector<judge::GateResult> results;
  for (const char* typed : plans) {
    const measure::Plan plan = measure::load_plan(typed, {}, registry.find_suite());
    judge::GateRequest request = request_of(truths, plan, registry.suite(plan.suite));
    request.checks = checks_of(plan.checks);
    request.devices = arguments.devices;
    const std::optional<record::Run> run = store.latest_run(plan.name);
    const std::string id = run && !before.contains(run->id) ? run->id : "";
    results.push_back(judge_named(store, id, arguments.baselines, request));
  }
  return tell_verdict(
      store, truths, arguments.baselines, results, since.seconds(),
      {.folder = arguments.out, .junit = arguments.junit, .markdown = {}, .json = arguments.json});
}

}  // namespace

void add_validate_command(Commands& commands) {
  auto arguments = std::make_shared<ValidateArguments>();
  CLI::App* command =
      commands.add("validate", "Everything a new driver must pass: pictures, work, hostile scenes",
                   [arguments] { return validate(*arguments); });
  command->add_option("--device", arguments->devices, "Glob over device ids (repeatable)")
      ->required();
  command
      ->add_option("--out", arguments->out,
                   "Folder for the store and what the gate writes for a CI")
      ->capture_default_str();
  command->add_option("--junit", arguments->junit, "Write JUnit XML of all plans");
  command->add_option("--json", arguments->json, "Write every finding as JSON; -: print it");
  command->add_flag(
      "--resume", arguments->resume,
      "Go on with what is in the folder's store, after a kill or a crash of the machine");
  add_baselines_option(*command, arguments->baselines);
}

}  // namespace triptych::app
