#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "app/code_plans.hpp"
#include "app/compare_sides.hpp"
#include "app/measure_plans.hpp"
#include "app/paths.hpp"
#include "app/registry.hpp"
#include "app/terminal.hpp"
#include "app/verdicts.hpp"
#include "app/version.hpp"
#include "app/writable_baselines.hpp"
#include "core/foreign_error.hpp"
#include "core/glob.hpp"
#include "core/output_files.hpp"
#include "core/quoting.hpp"
#include "judge/gate/gate.hpp"
#include "measure/plan/plan.hpp"
#include "measure/system/compile_only.hpp"
#include "measure/system/stopwatch.hpp"
#include "measure/worker/listing.hpp"
#include "record/check.hpp"

namespace triptych::app {
namespace {

struct GateArguments {
  std::vector<std::string> plans;  // as typed by the user
  PlanChoice choice;
  std::string store = default_store;
  std::string baselines = default_baselines().string();
  std::vector<std::string> checks;
  std::vector<std::string> without;
  std::vector<std::string> devices;
  std::vector<std::string> required;
  std::vector<std::string> without_devices;
  std::vector<std::string> faults;
  std::string base;
  std::string out;
  std::string junit;
  std::string markdown;
  bool measure = false;
  bool json = false;
  bool times = false;
  bool bisect = false;
  bool without_data = false;
  bool verbose = false;
  std::string ci = default_ci;
};

struct AcceptArguments {
  std::vector<std::string> plans;  // as typed by the user
  PlanChoice choice;
  std::string store = default_store;
  std::string baselines;  // empty: ./baselines
  std::string reason;
  std::string only;
  bool drop = false;
};

struct JudgedPlan {
  std::string typed;
  measure::Plan plan;
  record::Checks checks;
  std::vector<std::string> devices = {};  // globs; if empty, GateArguments::devices applies
};

// Returns the plans that the gate judges if the user names none.
std::vector<std::string> default_gate_plans() {
  std::vector<std::string> plans = default_plans;
  plans.insert(plans.end(), code_plans.begin(), code_plans.end());
  return plans;
}

// Returns the plans to judge, as they are defined now, which may differ from their definition when
// the run was measured. If the user names no plans, leaves out the default plans that have none of
// the requested checks. `--without cost` also leaves out the plans that count instructions, and
// `--without code` the plans that only compile code.
std::vector<JudgedPlan> plans_of(const GateArguments& arguments, const Registry& registry) {
  record::Checks requested_checks;
  for (const std::string& name : arguments.checks) requested_checks.insert(record::check(name));
  record::Checks without;
  for (const std::string& name : arguments.without) without.insert(record::check(name));
  std::vector<JudgedPlan> plans;
  for (const std::string& typed :
       arguments.plans.empty() ? default_gate_plans() : arguments.plans) {
    JudgedPlan each{typed, arguments.choice.load(typed, registry.find_suite()), requested_checks};
    if (each.plan.configurations.empty() && arguments.choice.selects()) continue;
    const auto is_requested = [&](record::Check check) { return requested_checks.contains(check); };
    const bool is_default = arguments.plans.empty() && !requested_checks.empty();
    if (is_default && std::ranges::none_of(each.plan.checks, is_requested)) continue;
    if (each.plan.configurations.empty()) {
      throw core::NotSupported(
          fmt::format("{}: shard {} contains no configurations, so there is nothing to judge",
                      each.plan.name, arguments.choice.shard));
    }
    if (without.contains(record::Check::cost) && each.plan.counted()) continue;
    if (without.contains(record::Check::code) && each.plan.compiled()) continue;
    if (each.checks.empty()) each.checks = each.plan.checks;
    std::erase_if(each.checks, [&](record::Check check) { return without.contains(check); });
    if (!each.checks.empty()) plans.push_back(std::move(each));
  }
  if (plans.empty() && arguments.choice.selects()) throw nothing_selected(arguments.choice);
  if (plans.empty()) {
    throw core::InputError(
        "--check and --without together exclude every check of every plan; choose different "
        "checks");
  }
  return plans;
}

judge::GateRequest request_for(const GateArguments& arguments, const JudgedPlan& judged,
                               const Registry& registry, measure::Truths& truths) {
  judge::GateRequest request = request_of(truths, judged.plan, registry.suite(judged.plan.suite));
  request.devices = judged.devices.empty() ? arguments.devices : judged.devices;
  // A device that only compiles code (for a GPU that is not present) is required only for plans
  // with the check `code`. Any other device that --require names is required only for the remaining
  // plans.
  for (const std::string& glob : arguments.required) {
    const bool compiles = measure::compile_only(glob).has_value();
    if (compiles == judged.plan.compiled()) request.required_devices.push_back(glob);
  }
  request.without_devices = arguments.without_devices;
  for (std::string& name : registry.plan_names()) request.known_plans.insert(std::move(name));
  request.program = version();
  request.checks = judged.checks;
  request.times_decide = arguments.times;
  request.part = !arguments.choice.is_whole();
  return request;
}

// Compares the results of each device with its results under another build or driver, which the
// option --base selects. The baselines are not used.
core::ExitCode compare_with_base(const GateArguments& arguments) {
  const Registry registry = make_registry();
  const measure::Listing listing = measure::names_compile_only_device(arguments.devices)
                                       ? registry.devices_and_compilers(arguments.devices)
                                       : registry.devices(arguments.devices);
  std::vector<ComparisonRequest> comparisons =
      comparisons_with_base(arguments.base, measure::choose_devices(listing, arguments.devices));
  for (ComparisonRequest& each : comparisons) {
    each.plans = arguments.plans;
    if (each.plans.empty() && measure::compile_only(each.b.device)) each.plans = code_plans;
    each.choice = arguments.choice;
    each.faults = arguments.faults;
    each.times = arguments.times;
    each.verbose = arguments.verbose;
  }
  return compare_and_print(comparisons, arguments.json);
}

// Returns the devices of this machine if the gate measures, otherwise the devices of the stored
// run.
std::vector<record::Device> found_devices(const GateArguments& arguments, const Registry& registry,
                                          const JudgedPlan& judged) {
  if (arguments.measure) return registry.devices_and_compilers(arguments.devices).devices;
  std::vector<record::Device> found;
  // A missing store is reported as an error later.
  if (!std::filesystem::exists(arguments.store)) return found;
  const record::Store store(arguments.store, record::Store::Mode::read);
  const auto run = store.latest_run(judged.plan.name);
  if (!run) return found;
  for (const auto& entry : store.devices(run->id)) found.push_back(entry.device);
  return found;
}

// Limits default plans with the check `code` to devices for which the baselines contain compiled
// code, and removes plans for which there is no such device. Changes nothing if the user names
// plans or requires a device that only compiles.
void limit_to_stored_code(const GateArguments& arguments, const Registry& registry,
                          std::vector<JudgedPlan>& plans) {
  if (!arguments.plans.empty() || measure::names_compile_only_device(arguments.required)) return;
  std::optional<std::vector<record::Device>> found;
  std::erase_if(plans, [&](JudgedPlan& each) {
    if (!each.plan.compiled()) return false;
    if (!found) found = found_devices(arguments, registry, each);
    JudgedCompilers compilers =
        judged_compilers(each.plan, *found, arguments.devices, arguments.baselines);
    if (arguments.measure) print_not_judged(compilers, each.typed);
    each.devices = std::move(compilers.devices);
    return each.devices.empty();
  });
  if (plans.empty()) {
    throw core::NotSupported(
        "there is nothing to judge, because the baselines contain no compiled code for these "
        "devices");
  }
}

core::ExitCode judge_and_print(const GateArguments& arguments, const measure::Stopwatch& since) {
  const CiSystem ci = ci_system(arguments.ci);
  if (!arguments.base.empty()) return compare_with_base(arguments);
  const Registry registry = make_registry();
  std::vector<JudgedPlan> plans = plans_of(arguments, registry);
  limit_to_stored_code(arguments, registry, plans);
  if (arguments.measure) {
    std::vector<std::string> typed;
    for (const JudgedPlan& each : plans) typed.push_back(each.typed);
    measure_resumably({.plans = typed,
                       .choice = arguments.choice,
                       .devices = arguments.devices,
                       .required = arguments.required,
                       .store = arguments.store,
                       .faults = arguments.faults,
                       .brief = !arguments.times,
                       .statistics = true,
                       .verbose = arguments.verbose,
                       .ci = ci,
                       .summary_output = stderr});
  }
  record::Store store = open_to_judge(arguments.store);
  measure::Truths truths(registry.find_suite(), store);
  std::vector<judge::GateResult> results;
  for (const JudgedPlan& each : plans) {
    const judge::GateRequest request = request_for(arguments, each, registry, truths);
    results.push_back(judge_stored_run(store, latest_run_of(store, each.typed, arguments.store),
                                       arguments.baselines, request));
    if (arguments.without_data) excuse_absent_data(store, results.back());
  }
  return report_verdict(store, truths, results, since.seconds(),
                        {.folder = arguments.out,
                         .junit = arguments.junit,
                         .markdown = arguments.markdown,
                         .json = arguments.json ? "-" : "",
                         .baselines = arguments.baselines,
                         .ci = ci});
}

void reject_invalid_options(const GateArguments& arguments) {
  if (!arguments.faults.empty() && !arguments.measure && arguments.base.empty()) {
    throw core::InputError(
        "--inject needs --measure or --base, because faults are injected during measurement");
  }
  std::vector<core::NamedFile> read{{"--store", arguments.store}};
  for (const std::string& plan : arguments.plans) read.push_back({"PLAN", plan});
  core::refuse_overwriting(read,
                           {{"--junit", arguments.junit}, {"--markdown", arguments.markdown}});
}

// Judges the plans and returns the exit code. With --bisect, if no verdict is possible, this is the
// exit code that makes `git bisect run` skip the commit.
core::ExitCode gate(const GateArguments& arguments) {
  const measure::Stopwatch since;
  const auto judged = [&] {
    reject_invalid_options(arguments);
    return judge_and_print(arguments, since);
  };
  if (!arguments.bisect) return judged();
  try {
    const core::ExitCode code = core::with_error_context({}, judged);
    return code == core::ExitCode::cannot_judge ? bisect_skip_code : code;
  } catch (const core::Error& error) {
    print_err("triptych: {}\n", error.what());
    return bisect_skip_code;
  }
}

void accept_one(const AcceptArguments& arguments, const std::string& typed, record::Store& store,
                measure::Truths& truths, const WritableBaselines& baselines) {
  const std::string plan = measure::plan_name(typed);
  const judge::GateRequest judged = request_of(truths, plan);
  const judge::AcceptRequest request{
      .plan = plan,
      .argument = typed,
      .store_option = store_option(arguments.store),
      .reason = arguments.reason,
      .only = arguments.only,
      .date = judged.today,
      .drop = arguments.drop,
      .truth = [&](const record::Record& record) { return truths.of(record).truth; },
      .data_hash = judged.data_hash,
      .limit = judged.limit,
      .stress = judge::StressTruths{judged.truth, judged.expectations}};
  const std::vector<std::string> changes = judge::accept(
      store, latest_run_of(store, typed, arguments.store), baselines.folder(), request);
  for (const std::string& change : changes) print_lines(change + "\n");
  if (changes.empty()) {
    print_out("{}: the baselines in {} are unchanged\n", plan, baselines.name().string());
  } else {
    print_out("{}: review these changes in {} before you commit\n", plan,
              baselines.name().string());
  }
}

// Returns the plans that the user names, or all plans in the store if the user names none.
std::vector<std::string> plans_to_accept(const AcceptArguments& arguments,
                                         const record::Store& store) {
  if (!arguments.plans.empty()) return arguments.plans;
  std::vector<std::string> plans;
  for (const record::Run& run : latest_runs(store)) plans.push_back(run.plan);
  if (plans.empty()) {
    throw core::NotSupported(
        fmt::format("{} contains no runs; measure first with `triptych run`", arguments.store));
  }
  return plans;
}

core::ExitCode accept(const AcceptArguments& arguments) {
  const Registry registry = make_registry();
  record::Store store = open_to_judge(arguments.store);
  measure::Truths truths(registry.find_suite(), store);
  WritableBaselines baselines(arguments.baselines);
  for (const std::string& typed : plans_to_accept(arguments, store)) {
    accept_one(arguments, typed, store, truths, baselines);
  }
  baselines.commit();
  if (!baselines.copied_from().empty()) {
    print_out(
        "{} was created as a copy of {}, and then the accepted baselines were written to it\n",
        baselines.name().string(), baselines.copied_from().string());
  }
  return core::ExitCode::pass;
}

void add_accept_command(Commands& commands) {
  auto [command, arguments] =
      commands.add("accept", "Accept the latest run of each plan as the new baseline", accept);
  add_example(command,
              "triptych accept volume/quick --store results.sqlite --reason 'new driver version'");
  command.add_option("PLAN", arguments.plans,
                     "Plans to accept, named as in the `run` command: SUITE/PLAN or a YAML file "
                     "(default: every plan in the store)");
  command
      .add_option("--reason", arguments.reason,
                  "Reason for the change; it is saved in history.json")
      ->required();
  command.add_option("--only", arguments.only, "Accept only configurations that match this glob");
  command.add_flag("--drop", arguments.drop,
                   "Also remove the baselines of configurations that are missing from the run, and "
                   "discard baseline files that were edited after they were accepted; with --only, "
                   "remove the baselines of matching configurations that a device now skips");
  command.add_option("--store", arguments.store, "SQLite file that contains the results")
      ->capture_default_str();
  add_baselines_option(command, arguments.baselines,
                       "Write the baselines to this folder (default: ./baselines; if it does not "
                       "exist, it is created as a copy of the installed baselines)");
}

}  // namespace

void add_gate_commands(Commands& commands) {
  auto [command, arguments] = commands.add(
      "gate", "Judge the latest run of each plan; with --measure, measure the plans first", gate);
  add_example(command, "triptych gate --measure --store gate.sqlite --out out");
  command.add_option(
      "PLAN", arguments.plans,
      fmt::format(
          "Plans to judge, named as in the `run` command: SUITE/PLAN or a YAML file (default: {})",
          fmt::join(default_gate_plans(), " ")));
  add_choice_options(command, arguments.choice);
  command.add_flag("--measure", arguments.measure, "Measure the plans before judging them");
  command
      .add_option(
          "--store", arguments.store,
          "SQLite file that contains the results; with --measure, new results are added to it")
      ->capture_default_str();
  add_baselines_option(command, arguments.baselines);
  command
      .add_option(
          "--check", arguments.checks,
          fmt::format(
              "Run only these checks (default: all checks of the plan); available checks: {}",
              record::text_of(record::every_check())))
      ->delimiter(',');
  command
      .add_option("--without", arguments.without,
                  "Omit these checks; omitting `cost` also omits the plans that count "
                  "instructions, and omitting `code` also omits the plans that only compile")
      ->delimiter(',');
  add_devices_option(command, arguments.devices);
  command.add_option("--require", arguments.required,
                     "Exit with code 2 unless every plan contains a measurement from a device that "
                     "matches this glob (repeatable)");
  command.add_option(
      "--without-device", arguments.without_devices,
      "Do not report that a device is missing on this machine if the device matches this glob; "
      "also ignore failed device enumeration for APIs that match the glob (repeatable; see "
      "docs/gate.md)");
  add_without_data_option(command, arguments.without_data);
  command.add_flag("--times", arguments.times,
                   "Let frame times affect the verdict (only for dedicated benchmarking machines)");
  CLI::Option* base =
      command.add_option("--base", arguments.base,
                         "PROGRAM or NAME=VALUE,…: do not use baselines; instead, measure each "
                         "device a second time with another triptych build (PROGRAM) or with "
                         "another driver (selected by these environment variables), and compare "
                         "the two measurements");
  command.add_option("--out", arguments.out,
                     "Write report.html, gate.log, summary.md, benchmark.json and one JUnit XML "
                     "file per plan to this folder");
  command.add_option("--junit", arguments.junit,
                     "Write a JUnit XML report for all plans to this file");
  command.add_option("--markdown", arguments.markdown, "Write a Markdown summary to this file");
  command.add_flag("--json", arguments.json, "Print all findings as JSON");
  add_verbose_option(command, arguments.verbose);
  add_ci_option(command, arguments.ci);
  command.add_flag(
      "--bisect", arguments.bisect,
      "Exit with code 125 instead of 2 or 3, so that `git bisect run` skips the commit");
  for (const char* other : {"--measure", "--store", "--baselines", "--check", "--without",
                            "--require", "--without-device", "--out", "--junit", "--markdown"}) {
    base->excludes(other);
  }
  add_inject_option(command, arguments.faults,
                    "Inject a fault (repeatable; see `triptych run --help`); needs --measure or "
                    "--base");
  add_accept_command(commands);
}

}  // namespace triptych::app
