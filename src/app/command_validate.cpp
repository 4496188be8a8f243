#include <array>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "app/arguments.hpp"
#include "app/measure_plans.hpp"
#include "app/paths.hpp"
#include "app/registry.hpp"
#include "app/terminal.hpp"
#include "app/verdicts.hpp"
#include "core/output_files.hpp"
#include "judge/gate/flakes.hpp"
#include "measure/run/runner.hpp"
#include "measure/system/stopwatch.hpp"
#include "report/words/finding.hpp"

namespace triptych::app {
namespace {

// Everything that a driver must get right, whatever its speed: ordinary scenes with every
// technique, hostile scenes, and closed forms.
constexpr std::array<const char*, 6> validation_plans{"volume/quick",     "volume/stress",
                                                      "volume/accuracy",  "particles/quick",
                                                      "particles/stress", "particles/accuracy"};

struct ValidateArguments {
  std::vector<std::string> devices;
  std::string out = "validation";
  std::string baselines = default_baselines().string();
  std::string junit;
  std::string json;
  PlanChoice choice;  // only its shard
  int jobs = 0;       // see measure::RunOptions
  int limit_s = standard_limit_s;
  std::string expect;
  std::string write_expect;
  bool resume = false;
};

// Times, image bits and statistics differ between devices. Any device must draw the right image
// from the right amount of work. The score of a stress case includes its image.
record::Checks checks_of(const record::Checks& of_plan) {
  const bool scored = of_plan.contains(judge::Check::stress);
  return {scored ? judge::Check::stress : judge::Check::image, judge::Check::counters};
}

Measuring measuring_of(const ValidateArguments& arguments, const std::string& file) {
  return {.plans = {validation_plans.begin(), validation_plans.end()},
          .choice = arguments.choice,
          .devices = arguments.devices,
          .store = file,
          .resume = arguments.resume,
          .jobs = arguments.jobs,
          .limit_s = arguments.limit_s,
          .untimed = true,
          .statistics = true,
          .told_to = stderr};
}

// Returns false if the run was interrupted. The part that was measured is judged anyway.
bool measured_to_its_end(const Measuring& measuring) {
  try {
    measure_resumably(measuring);
    return true;
  } catch (const measure::Interrupted& interrupted) {
    say("triptych: {}\n", interrupted.what());
    return false;
  }
}

// Runs of an earlier validation, which this one does not continue.
std::set<std::string> runs_before(const ValidateArguments& arguments, const std::string& file) {
  std::set<std::string> ids;
  if (arguments.resume || !std::filesystem::exists(file)) return ids;
  for (const record::Run& run : record::Store(file, record::Store::Mode::read).runs()) {
    ids.insert(run.id);
  }
  return ids;
}

// The plans of a validation, and the results of each.
class Validation {
 public:
  // `before` contains runs that do not belong to this validation.
  Validation(const ValidateArguments& arguments, const std::string& file,
             const std::set<std::string>& before, std::optional<std::vector<judge::Waiver>> known)
      : arguments_(arguments),
        before_(before),
        registry_(make_registry()),
        store_(open_to_judge(file)),
        truths_(registry_.find_suite(), store_),
        known_(std::move(known)) {}

  void judge_all() {
    for (const char* typed : validation_plans) {
      const measure::Plan plan = arguments_.choice.load(typed, registry_.find_suite());
      if (!plan.configurations.empty()) results_.push_back(judge_plan(plan));
    }
  }

  // A fault that does not recur is still a fault, but of another kind.
  void draw_failures_again() {
    for (judge::GateResult& result : results_) {
      const judge::Places places = judge::failing(result);
      if (places.empty()) continue;
      const std::vector<record::Record> first = store_.records(result.run);
      if (!draw_again(result.plan, places)) return;
      const measure::Plan plan = arguments_.choice.load(result.plan, registry_.find_suite());
      auto [second, flakes] = judge::tell_flakes(result, judge_plan(plan), places);
      result = std::move(second);
      for (const record::Record& each : first) {  // the store keeps the failed records
        if (flakes.contains({each.device, each.configuration})) store_.add_record(each);
      }
    }
  }

  core::ExitCode tell(double seconds) {
    if (!arguments_.write_expect.empty()) {
      const auto reason_of = [](const judge::Finding& finding) {
        return report::words::text_of(static_cast<const judge::Observation&>(finding));
      };
      core::write_text(arguments_.write_expect,
                       judge::expected_text(judge::as_expected(results_, reason_of)));
    }
    return tell_verdict(store_, truths_, results_, seconds,
                        {.folder = arguments_.out,
                         .junit = arguments_.junit,
                         .markdown = {},
                         .json = arguments_.json});
  }

 private:
  judge::GateResult judge_plan(const measure::Plan& plan) {
    judge::GateRequest request = request_of(truths_, plan, registry_.suite(plan.suite));
    request.checks = checks_of(plan.checks);
    request.devices = arguments_.devices;
    request.part = !arguments_.choice.shard.empty();
    request.known = known_;
    const std::optional<record::Run> run = store_.latest_run(plan.name);
    const std::string id = run && !before_.contains(run->id) ? run->id : "";
    return judge_named(store_, id, arguments_.baselines, request);
  }

  // Returns false if it was interrupted.
  bool draw_again(const std::string& plan, const judge::Places& places) {
    say("{}: {} that failed are drawn again\n", plan, places.size());
    Measuring measuring = measuring_of(arguments_, store_.file().string());
    measuring.plans = {plan};
    measuring.resume = true;
    measuring.again = places;
    return measured_to_its_end(measuring);
  }

  const ValidateArguments& arguments_;
  const std::set<std::string>& before_;
  Registry registry_;
  record::Store store_;
  measure::Truths truths_;
  std::optional<std::vector<judge::Waiver>> known_;
  std::vector<judge::GateResult> results_;
};

core::ExitCode validate(const ValidateArguments& arguments) {
  const measure::Stopwatch since;
  core::refuse_overwriting({{"--expect", arguments.expect}},
                           {{"--junit", arguments.junit},
                            {"--json", arguments.json},
                            {"--write-expect", arguments.write_expect}});
  std::optional<std::vector<judge::Waiver>> known;
  if (!arguments.expect.empty()) known = judge::read_expected(arguments.expect);
  core::require_writable(arguments.out);
  const std::string file = (std::filesystem::path(arguments.out) / "validation.sqlite").string();
  const std::set<std::string> before = runs_before(arguments, file);
  const bool whole = measured_to_its_end(measuring_of(arguments, file));
  Validation validation(arguments, file, before, std::move(known));
  validation.judge_all();
  if (whole) validation.draw_failures_again();
  return validation.tell(since.seconds());
}

}  // namespace

void add_validate_command(Commands& commands) {
  auto [command, arguments] = commands.add(
      "validate", "Check everything that a new driver must get right: images, work, hostile scenes",
      validate);
  add_example(command, "triptych validate --device vulkan:lavapipe --out validation");
  command.add_option("--device", arguments.devices, "Devices that match this glob (repeatable)")
      ->required();
  command
      .add_option("--out", arguments.out,
                  "Folder for the store and for the files that the gate writes for a CI system")
      ->capture_default_str();
  command.add_option("--junit", arguments.junit, "Write JUnit XML of all plans");
  command.add_option("--json", arguments.json,
                     "Write every finding as JSON to this file; - prints it");
  command.add_flag(
      "--resume", arguments.resume,
      "Continue with the store in the folder, after an interruption or a crash of the machine");
  command
      .add_option("--jobs", arguments.jobs,
                  "Number of workers that run at once, also for one device (default: one for each "
                  "device)")
      ->check(CLI::Range(1, 64));
  add_limit_option(command, arguments.limit_s, "a configuration");
  command.add_option("--shard", arguments.choice.shard,
                     "i/n: only the i-th of n parts of each plan");
  command.add_option("--expect", arguments.expect,
                     "A file of --write-expect with known failures, flakes and skips: they are "
                     "waived, and everything else has to pass");
  command.add_option("--write-expect", arguments.write_expect,
                     "Write failures, flakes and skips to this file, for --expect");
  add_baselines_option(command, arguments.baselines);
}

}  // namespace triptych::app
