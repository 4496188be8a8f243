#include <array>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "app/arguments.hpp"
#include "app/feature_table.hpp"
#include "app/measure_plans.hpp"
#include "app/paths.hpp"
#include "app/registry.hpp"
#include "app/terminal.hpp"
#include "app/validate_arguments.hpp"
#include "app/verdicts.hpp"
#include "core/json_text.hpp"
#include "core/output_files.hpp"
#include "judge/gate/flakes.hpp"
#include "judge/gate/repeats.hpp"
#include "measure/run/runner.hpp"
#include "measure/system/stopwatch.hpp"
#include "report/screen/coverage.hpp"
#include "report/screen/repeats.hpp"
#include "report/words/finding.hpp"

namespace triptych::app {
namespace {

// Plans that cover everything that a driver must get right, regardless of its speed: ordinary
// scenes with every technique, stress scenes (on which renderers often fail), and scenes with
// closed-form solutions.
constexpr std::array<const char*, 6> validation_plans{"volume/quick",     "volume/stress",
                                                      "volume/accuracy",  "particles/quick",
                                                      "particles/stress", "particles/accuracy"};

// A validation checks only images and counters. Every device must draw the correct image with the
// correct amount of work, but frame times, exact pixel values and statistics differ between
// devices. A stress case is judged by its score, which includes its image.
record::Checks checks_of(const record::Checks& of_plan) {
  const bool scored = of_plan.contains(judge::Check::stress);
  return {scored ? judge::Check::stress : judge::Check::image, judge::Check::counters};
}

MeasureRequest measure_request(const ValidateArguments& arguments, const std::string& file) {
  return {.plans = {validation_plans.begin(), validation_plans.end()},
          .choice = arguments.choice,
          .devices = arguments.devices,
          .store = file,
          .resume = arguments.resume,
          .jobs = arguments.jobs,
          .limit_s = arguments.limit_s,
          .untimed = true,
          .statistics = true,
          .verbose = arguments.verbose,
          .ci = ci_system(arguments.ci),
          .summary_output = stderr};
}

// Measures the plans. Returns false if the user interrupted the run; the configurations measured
// until then are judged nevertheless.
bool run_to_completion(const MeasureRequest& request) {
  try {
    measure_resumably(request);
    return true;
  } catch (const measure::Interrupted& interrupted) {
    print_err("triptych: {}\n", interrupted.what());
    return false;
  }
}

// Returns the ids of the runs that earlier calls of `validate` left in the store.
std::set<std::string> run_ids(const std::string& file) {
  std::set<std::string> ids;
  if (!std::filesystem::exists(file)) return ids;
  for (const record::Run& run : record::Store(file, record::Store::Mode::read).runs()) {
    ids.insert(run.id);
  }
  return ids;
}

// Judges the plans of a validation, and holds the result for each plan.
class Validation {
 public:
  // `before` contains the ids of the runs that were in the store before this validation began.
  Validation(const ValidateArguments& arguments, const std::string& file,
             const std::set<std::string>& before, std::optional<std::vector<judge::Waiver>> known)
      : arguments_(arguments),
        earlier_runs_(before),
        registry_(make_registry()),
        store_(open_to_judge(file)),
        truths_(registry_.find_suite(), store_),
        known_failures_(std::move(known)) {}

  void judge_all() {
    for (const char* typed : validation_plans) {
      const measure::Plan plan = arguments_.choice.load(typed, registry_.find_suite());
      if (!plan.configurations.empty()) results_.push_back(judge_plan(plan));
    }
  }

  // Draws all failed configurations once more. A failure that does not recur is still a failure,
  // but it is reported as a flake.
  void draw_failures_again() {
    for (judge::GateResult& result : results_) {
      const judge::CaseSet places = judge::failing_cases(result);
      if (places.empty()) continue;
      const std::vector<record::Record> first = store_.records(result.run);
      if (!draw_again(result.plan, places)) return;
      const measure::Plan plan = arguments_.choice.load(result.plan, registry_.find_suite());
      auto [second, flakes] = judge::mark_flakes(result, judge_plan(plan), places);
      result = std::move(second);
      // Keep the failed records of flaky configurations in the store.
      for (const record::Record& each : first) {
        if (flakes.contains({each.device, each.configuration})) store_.add_record(each);
      }
    }
  }

  // Returns the devices that were opened, including devices on which nothing was measured.
  [[nodiscard]] std::vector<std::string> devices() const {
    std::set<std::string> ids;
    for (const judge::GateResult& result : results_) {
      for (const auto& entry : store_.devices(result.run)) ids.insert(entry.device.id);
    }
    return {ids.begin(), ids.end()};
  }

  // Returns the results of this repetition, with the hash of each image.
  [[nodiscard]] judge::Repetition repetition() const {
    judge::Repetition repetition{.results = results_, .images = {}};
    for (const judge::GateResult& result : results_) {
      for (const record::Record& each : store_.records(result.run)) {
        if (each.image.empty()) continue;
        repetition.images[{result.plan, each.device, each.configuration}] = each.image;
      }
    }
    return repetition;
  }

  void add_flakes(const std::vector<judge::RepeatedCase>& cases) {
    judge::add_flakes(cases, results_);
  }

  // Writes the levels and features that the validation has covered to coverage.txt and
  // coverage.json, so that readers know what a pass means, and prints a summary of at most ten
  // lines.
  void report_coverage(const FeatureTable& features) {
    std::vector<record::Record> records;
    for (const judge::GateResult& result : results_) {
      const std::vector<record::Record> of_plan = store_.records(result.run);
      records.insert(records.end(), of_plan.begin(), of_plan.end());
    }
    const auto coverage = report::coverage_of(records);
    const std::string text = report::coverage_text(coverage) + "API features that no scene uses\n" +
                             feature_text(features);
    const std::filesystem::path folder(arguments_.out);
    core::write_text(folder / "coverage.txt", text + report::bounds_text(wide_bounds(records)));
    core::write_text(
        folder / "coverage.json",
        core::json_text(
            {{"drawn", report::coverage_json(coverage)}, {"features", feature_json(features)}}, 2) +
            "\n");
    print_lines(report::coverage_summary(coverage) + feature_summary(features), stderr);
    print_err("all covered levels, largest values and features: {}\n",
              (folder / "coverage.txt").string());
  }

  core::ExitCode report_results(double seconds) {
    if (!arguments_.write_expect.empty()) {
      const auto reason_of = [](const judge::Finding& finding) {
        return report::words::text_of(static_cast<const judge::Observation&>(finding));
      };
      core::write_text(
          arguments_.write_expect,
          judge::expected_outcomes_text(judge::expected_outcomes_of(results_, reason_of)));
    }
    return report_verdict(store_, truths_, results_, seconds,
                          {.folder = arguments_.out,
                           .junit = arguments_.junit,
                           .markdown = {},
                           .json = arguments_.json,
                           .baselines = arguments_.baselines,
                           .ci = ci_system(arguments_.ci)});
  }

 private:
  // Returns the largest error bound of any pixel of the image, or 0 if there is no reference image,
  // for example because the data file is now missing.
  [[nodiscard]] double bound_of(const record::Record& record) {
    try {
      return report::largest_bound(truths_.of(record).bound);
    } catch (const core::Error&) {
      return 0;
    }
  }

  // Returns the records whose image was judged with an error bound larger than one 8-bit step of a
  // colour channel.
  [[nodiscard]] std::vector<report::WideBound> wide_bounds(
      const std::vector<record::Record>& records) {
    std::vector<report::WideBound> bounds;
    for (const record::Record& each : records) {
      if (each.image.empty() || !each.same_as.empty()) continue;
      const double bound = bound_of(each);
      if (bound <= report::eight_bit_step) continue;
      const auto samples = each.counters.find("samples");
      const auto rays = each.counters.find("rays_hit");
      const bool has_rays =
          samples != each.counters.end() && rays != each.counters.end() && rays->second > 0;
      bounds.push_back({.device = each.device,
                        .configuration = each.plan + " " + each.configuration,
                        .bound = bound,
                        .samples_per_ray = has_rays ? static_cast<double>(samples->second) /
                                                          static_cast<double>(rays->second)
                                                    : 0.0});
    }
    return bounds;
  }

  judge::GateResult judge_plan(const measure::Plan& plan) {
    judge::GateRequest request = request_of(truths_, plan, registry_.suite(plan.suite));
    request.checks = checks_of(plan.checks);
    request.devices = arguments_.devices;
    request.part = !arguments_.choice.is_whole();
    request.expected_outcomes = known_failures_;
    request.resume_command = resume_command(arguments_);
    for (std::string& name : registry_.plan_names()) request.known_plans.insert(std::move(name));
    const std::optional<record::Run> run = store_.latest_run(plan.name);
    const std::string id = run && !earlier_runs_.contains(run->id) ? run->id : "";
    judge::GateResult result = judge_stored_run(store_, id, arguments_.baselines, request);
    if (arguments_.without_data) excuse_absent_data(store_, result);
    return result;
  }

  // Draws the failed configurations again. Returns false if the user interrupted the run.
  bool draw_again(const std::string& plan, const judge::CaseSet& places) {
    print_err("{}: drawing {} failed configurations again\n", plan, places.size());
    MeasureRequest request = measure_request(arguments_, store_.file().string());
    request.plans = {plan};
    request.resume = true;
    request.again = places;
    return run_to_completion(request);
  }

  const ValidateArguments& arguments_;
  const std::set<std::string>& earlier_runs_;
  Registry registry_;
  record::Store store_;
  measure::Truths truths_;
  std::optional<std::vector<judge::Waiver>> known_failures_;
  std::vector<judge::GateResult> results_;
};

// Repeats the whole measurement until the requested number of repetitions is reached or the user
// interrupts it. The interrupted repetition is discarded.
std::vector<judge::Repetition> repeat(const ValidateArguments& arguments, const std::string& file,
                                      const std::optional<std::vector<judge::Waiver>>& known,
                                      const Validation& first) {
  std::vector<judge::Repetition> repetitions{first.repetition()};
  ValidateArguments again = arguments;
  again.resume = false;
  for (int n = 2; n <= arguments.repeat; ++n) {
    print_err("repetition {} of {}\n", n, arguments.repeat);
    const std::set<std::string> before = run_ids(file);
    if (!run_to_completion(measure_request(again, file))) break;
    Validation validation(again, file, before, known);
    validation.judge_all();
    repetitions.push_back(validation.repetition());
  }
  return repetitions;
}

// Compares the repetitions. Prints the result and writes it to repeats.jsonl, with one line for
// each case (one configuration of a plan on one device).
void report_repeats(const ValidateArguments& arguments,
                    const std::vector<judge::Repetition>& repetitions, Validation& first) {
  const std::vector<judge::RepeatedCase> cases = judge::repeated_cases(repetitions);
  first.add_flakes(cases);
  core::write_text(std::filesystem::path(arguments.out) / "repeats.jsonl",
                   report::repeats_json_lines(cases));
  print_lines(report::repeats_text(cases, repetitions.size()), stderr);
}

// Probes the features of the devices. With --shard, only the first part of the plans probes
// features, so that they are probed once.
FeatureTable features_of(const ValidateArguments& arguments, const Validation& validation) {
  const std::string& shard = arguments.choice.shard;
  if (!shard.empty() && !shard.starts_with("1/")) return {};
  return probe_devices(validation.devices(), "", arguments.limit_s);
}

core::ExitCode validate(const ValidateArguments& arguments) {
  const measure::Stopwatch since;
  if (arguments.devices.empty()) make_registry().refuse_missing_device();
  // Checks the value of --ci before anything is measured; throws if it is unknown.
  static_cast<void>(ci_system(arguments.ci));
  core::refuse_overwriting({{"--expect", arguments.expect}},
                           {{"--junit", arguments.junit},
                            {"--json", arguments.json},
                            {"--write-expect", arguments.write_expect}});
  std::optional<std::vector<judge::Waiver>> known;
  if (!arguments.expect.empty()) known = judge::read_expected_outcomes(arguments.expect);
  core::require_writable(arguments.out);
  const std::string file = (std::filesystem::path(arguments.out) / "validation.sqlite").string();
  const std::set<std::string> before = arguments.resume ? std::set<std::string>{} : run_ids(file);
  const bool whole = run_to_completion(measure_request(arguments, file));
  Validation validation(arguments, file, before, known);
  validation.judge_all();
  if (whole) validation.draw_failures_again();
  if (whole && arguments.repeat > 1) {
    report_repeats(arguments, repeat(arguments, file, known, validation), validation);
  }
  const FeatureTable features = whole ? features_of(arguments, validation) : FeatureTable{};
  validation.report_coverage(features);
  const core::ExitCode code = validation.report_results(since.seconds());
  if (verdict_of(features) != core::ExitCode::regression) return code;
  print_err(
      "the exit code is 1, because a device failed the probe of an API feature that no scene uses; "
      "see coverage.txt\n");
  return core::ExitCode::regression;
}

}  // namespace

void add_validate_command(Commands& commands) {
  auto [command, arguments] = commands.add("validate",
                                           "Check everything that a new driver must get right: the "
                                           "images, the work counters and the stress scenes",
                                           validate);
  add_example(command,
              "triptych validate --device vulkan:lavapipe --without-data --out validation");
  command.add_option("--device", arguments.devices,
                     "Validate devices that match this glob (repeatable; required)");
  command
      .add_option("--out", arguments.out,
                  "Write to this folder: the store, and the same files that `gate --out` writes")
      ->capture_default_str();
  command.add_option("--junit", arguments.junit,
                     "Write a JUnit XML report for all plans to this file");
  command.add_option("--json", arguments.json,
                     "Write all findings as JSON to this file; use - for standard output");
  command.add_flag("--resume", arguments.resume,
                   "Continue an interrupted validation from the store in the --out folder, even "
                   "after a machine crash");
  command
      .add_option("--jobs", arguments.jobs,
                  "Run this many worker processes at the same time, even on a single device "
                  "(default: one per device)")
      ->check(CLI::Range(1, 64));
  command
      .add_option("--repeat", arguments.repeat,
                  "Draw everything this many times; a case that fails in only some repetitions is "
                  "a flake, which counts as a failure; repeats.jsonl in the --out folder has one "
                  "line per case")
      ->check(CLI::Range(1, 1000));
  add_limit_option(command, arguments.limit_s, "a configuration");
  command.add_option("--shard", arguments.choice.shard,
                     "i/n: divide each plan into n parts and use only the i-th part");
  add_selection_options(command, arguments.choice);
  command.add_option("--expect", arguments.expect,
                     "Waive the known failures, flakes and skips that are listed in this file (see "
                     "--write-expect); everything else must pass");
  command.add_option("--write-expect", arguments.write_expect,
                     "Write all failures, flakes and skips to this file, for use with --expect");
  add_baselines_option(command, arguments.baselines);
  add_without_data_option(command, arguments.without_data);
  add_verbose_option(command, arguments.verbose);
  add_ci_option(command, arguments.ci);
}

}  // namespace triptych::app
