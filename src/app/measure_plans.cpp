#include "app/measure_plans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <set>
#include <utility>

#include "app/error_search.hpp"
#include "app/progress_printer.hpp"
#include "app/registry.hpp"
#include "app/terminal.hpp"
#include "app/version.hpp"
#include "core/glob.hpp"
#include "core/output_files.hpp"
#include "measure/request/error_answer.hpp"
#include "measure/request/fastest.hpp"
#include "measure/system/compile_only.hpp"
#include "measure/system/system_facts.hpp"
#include "measure/worker/listing.hpp"
#include "measure/worker/own_program.hpp"
#include "record/clock_counts.hpp"
#include "report/screen/error_table.hpp"
#include "report/screen/unmeasured.hpp"
#include "report/words/clocks.hpp"
#include "report/words/requested_error.hpp"

namespace triptych::app {
namespace {

// Rejects options that apply to a single plan if several plans are named: --set, because its
// factors belong to one suite, and --error, because it is computed for the scenes of one plan.
void reject_options_for_one_plan(const MeasureRequest& request) {
  if (request.plans.size() < 2) return;
  if (!request.choice.set.empty()) {
    throw core::InputError(
        "--set applies to a single plan; name one plan, or write a YAML file for each plan");
  }
  if (request.error) throw core::InputError("--error applies to a single plan; name one plan");
}

std::vector<measure::Plan> load_plans(const MeasureRequest& request, const Registry& registry) {
  reject_options_for_one_plan(request);
  std::vector<measure::Plan> plans;
  for (const std::string& name : request.plans) {
    measure::Plan plan = request.choice.load(name, registry.find_suite());
    if (std::ranges::find(plans, plan.name, &measure::Plan::name) != plans.end()) {
      throw core::InputError(
          fmt::format("two plans are named {}; rename one of them, because runs are identified by "
                      "the plan's name",
                      plan.name));
    }
    if (plan.configurations.empty() && request.choice.selects()) continue;
    const bool report_fastest = request.report_fastest && !plan.automatic.empty();
    if (report_fastest && request.untimed && !plan.counted()) {
      throw core::InputError(
          fmt::format("{}: technique=auto needs frame times; remove --untimed", plan.name));
    }
    if ((request.timed || report_fastest) && !plan.counted()) {
      plan.checks.insert(record::Check::timing);
    }
    plans.push_back(std::move(plan));
  }
  if (plans.empty()) throw nothing_selected(request.choice);
  return plans;
}

measure::RunOptions options_of(const MeasureRequest& request, const record::RunStart& begun) {
  measure::Protocol protocol = request.brief ? measure::brief_protocol : measure::Protocol{};
  protocol.timed = !request.untimed;
  protocol.statistics = protocol.timed || request.statistics;
  protocol.measure_every = request.measure_every;
  std::vector<std::string> more;
  if (request.memory) more = {"--memory", fmt::to_string(*request.memory)};
  return {.protocol = protocol,
          .limit = std::chrono::seconds(request.limit_s),
          .resume = request.resume,
          .remeasure = request.again,
          .faults = measure::parse_faults(request.faults),
          .jobs = request.jobs,
          .worker_command = measure::worker_command(measure::own_program(), more),
          .begun = begun,
          .program = version()};
}

// The devices on which plans are measured, and the store that receives the records.
struct RunContext {
  const MeasureRequest& request;
  const Registry& registry;
  std::vector<std::string> devices;
  record::RunStart begun;
  record::Store& store;
};

// Returns the state at the beginning of the run: the host, and the requested, found and unusable
// devices. GPU families whose compiler is not installed are recorded only if the user named a GPU
// family or requires the device.
record::RunStart beginning_of(const measure::Listing& listing, const MeasureRequest& request) {
  record::RunStart begun{.host = measure::host_name(), .requested = request.devices};
  const bool named = measure::names_compile_only_device(request.devices);
  const auto is_required = [&](const std::string& id) {
    return core::any_glob_matches(request.required, id);
  };
  for (const record::Device& each : listing.devices) begun.found.push_back(each.id);
  for (const measure::Broken& each : listing.broken) {
    if (!named && measure::compile_only(each.what) && !is_required(each.what)) continue;
    begun.unusable.push_back({each.what, each.reason, each.ended});
  }
  return begun;
}

// Returns how many configurations of the plan are to be measured, over all devices. If a run is
// resumed, the configurations that it already contains are measured only if they were requested
// again.
int planned_measurements(const RunContext& context, const measure::Plan& plan) {
  std::optional<record::Run> resumed;
  if (context.request.resume) resumed = context.store.latest_run(plan.name);
  if (!resumed) return static_cast<int>(plan.configurations.size() * context.devices.size());
  const measure::Suite& suite = context.registry.suite(plan.suite);
  std::size_t planned = 0;
  for (const std::string& device : context.devices) {
    const std::set<std::string> stored = context.store.configurations(resumed->id, device);
    planned += static_cast<std::size_t>(
        std::ranges::count_if(plan.configurations, [&](const measure::Configuration& each) {
          const std::string key = measure::configuration_key(suite, each);
          return !stored.contains(key) || context.request.again.contains({device, key});
        }));
  }
  return static_cast<int>(planned);
}

// States how much will be measured, if there are several plans: a single plan shows its own
// progress.
void announce(const RunContext& context, const std::vector<std::pair<std::string, int>>& planned) {
  if (planned.size() < 2) return;
  int measurements = 0;
  for (const auto& [plan, count] : planned) measurements += count;
  const std::size_t devices = context.devices.size();
  print_err("measuring {} configurations of {} plans on {} device{}{}\n", measurements,
            planned.size(), devices, devices == 1 ? "" : "s",
            context.request.resume ? "; the other results are already in the store" : "");
}

// Prints why configurations of the run were skipped or failed.
void print_unmeasured(const RunContext& context, const measure::RunResult& result) {
  if (result.skipped + result.failed == 0) return;
  report::Unmeasured unmeasured;
  context.store.visit_records(result.run,
                              [&](const record::Record& record) { unmeasured.add(record); });
  for (const std::string& line : unmeasured.lines()) {
    print_lines("  " + line + "\n", context.request.summary_output);
  }
}

// Prints which clock the times of each device use.
void print_clocks(const RunContext& context, const std::string& run) {
  const auto before = record::clock_counts(context.store, record::previous_run(context.store, run));
  for (const auto& [device, clocks] : record::clock_counts(context.store, run)) {
    const auto earlier = before.find(device);
    print_lines(
        report::words::clocks_of(
            device, clocks, earlier == before.end() ? record::ClockCounts{} : earlier->second) +
            "\n",
        context.request.summary_output);
  }
}

std::vector<measure::RunResult> measure_on(const RunContext& context,
                                           const std::vector<measure::Plan>& plans) {
  const measure::RunOptions options = options_of(context.request, context.begun);
  std::vector<measure::PlannedRun> runs;
  runs.reserve(plans.size());
  for (const measure::Plan& plan : plans) {
    runs.push_back({plan, context.registry.suite(plan.suite), options});
  }
  std::vector<std::pair<std::string, int>> planned;
  for (const measure::Plan& plan : plans) {
    planned.emplace_back(plan.name, planned_measurements(context, plan));
  }
  announce(context, planned);
  ProgressPrinter printer(context.request.verbose, std::move(planned));
  std::vector<measure::RunResult> results;
  {
    const LogSection section(context.request.ci, "Measuring");
    results =
        measure::run_plans(runs, context.devices, context.store,
                           [&](const measure::Progress& progress) { printer.print(progress); });
    printer.end();
  }
  for (const auto& [fault, only] : measure::unmatched_faults(runs, context.devices)) {
    print_err(
        "triptych: --inject {}@{} has no effect, because no configuration or device matches; "
        "`triptych list PLAN` prints the names of configurations, which omit default levels\n",
        fault, only);
  }
  for (std::size_t i = 0; i < plans.size(); ++i) {
    print_lines(describe(results[i], plans[i].name, context.request.store),
                context.request.summary_output);
    if (context.request.report_unmeasured) print_unmeasured(context, results[i]);
    if (context.request.report_clocks) print_clocks(context, results[i].run);
  }
  return results;
}

// Draws trial images for the search of --error. Returns the id of the run in `store`.
std::string measure_trials(const RunContext& context, const measure::Plan& trials,
                           record::Store& store) {
  MeasureRequest request = context.request;
  request.untimed = true;
  request.resume = false;
  const measure::RunOptions options = options_of(request, context.begun);
  ProgressPrinter printer(request.verbose);
  const measure::RunResult result = measure::run_plan(
      trials, context.devices, context.registry.suite(trials.suite), store, options,
      [&](const measure::Progress& progress) { printer.print(progress); });
  printer.end();
  return result.run;
}

// Measures the configurations that meet the requested error, and finds the fastest configuration
// for each scene, device and technique.
MeasureResult measure_within_error(RunContext context, const measure::Plan& plan) {
  const measure::ErrorGoal goal =
      measure::error_goal(*context.request.error, names_of(context.request.choice.overrides()));
  measure::SuiteWithTruth& suite = context.registry.suite(plan.suite);
  measure::Truths truths(context.registry.find_suite(), context.store);
  const measure::ErrorRequest error_request = search_settings(
      plan, suite, goal, truths, [&](const measure::Plan& trials, record::Store& store) {
        return measure_trials(context, trials, store);
      });
  MeasureResult measured{.error_met = error_request.unreachable.empty()};
  std::vector<record::Record> records;
  if (!error_request.plan.configurations.empty()) {
    context.begun.requested_error = text_of(goal.request);
    context.begun.fixed = {goal.fixed.begin(), goal.fixed.end()};
    measured.results = measure_on(context, {error_request.plan});
    records = context.store.records(measured.results.front().run);
  }
  const std::vector<measure::ErrorAnswer> answers =
      measure::answer_error(records, suite, goal, truths);
  print_lines(report::error_tables(answers, goal.request));
  measured.error_met =
      measured.error_met && std::ranges::all_of(answers, [](const measure::ErrorAnswer& answer) {
        return answer.record != nullptr;
      });
  for (const measure::Unreachable& scene : error_request.unreachable) {
    print_lines(report::words::text_of(scene, goal.request) + "\n");
  }
  return measured;
}

void print_fastest(const RunContext& context, const measure::Plan& plan, const std::string& run) {
  if (plan.automatic.empty()) return;
  const std::vector<record::Record> records = context.store.records(run);
  for (const measure::FastestAnswer& answer :
       measure::answer_fastest(records, context.registry.suite(plan.suite), plan.automatic)) {
    print_lines(describe(answer, plan.automatic) + "\n");
  }
}

// Returns the devices on which plans are measured. Plans with the check `code` (`compiled`) are
// measured on GPUs and on devices that only compile code (for a GPU that is not present), but not
// on CPU devices, because the plans with the check `cost` already count the instructions of CPU
// devices. All other plans are measured on all devices except those that only compile.
std::vector<std::string> devices_of(const measure::Listing& listing,
                                    const std::vector<std::string>& globs, bool compiled) {
  std::vector<std::string> chosen = measure::choose_devices(listing, globs);
  std::vector<std::string> suitable;
  for (const std::string& id : chosen) {
    const auto device = std::ranges::find(listing.devices, id, &record::Device::id);
    const bool fits = compiled ? device->cpu_features.empty() : device->compiles_for.empty();
    if (fits) suitable.push_back(id);
  }
  // If the user names only unsuitable devices, they are returned nevertheless, so that each of them
  // is recorded as skipped with a reason.
  if (suitable.empty() && !globs.empty()) return chosen;
  return suitable;
}

measure::Listing listing_for(const MeasureRequest& request, const Registry& registry,
                             const std::vector<measure::Plan>& plans) {
  const bool compiled = std::ranges::any_of(plans, &measure::Plan::compiled);
  if (!compiled && !measure::names_compile_only_device(request.devices)) {
    return registry.devices(request.devices);
  }
  measure::Listing listing = registry.devices_and_compilers(request.devices);
  // Adds the required devices that only compile and are not yet listed: they may match no glob in
  // `devices`, and they need not be among the usual devices that devices_and_compilers() lists.
  std::vector<std::string> more = request.required;
  std::erase_if(more, [&](const std::string& id) {
    return !measure::compile_only(id) ||
           std::ranges::find(listing.devices, id, &record::Device::id) != listing.devices.end() ||
           std::ranges::find(listing.broken, id, &measure::Broken::what) != listing.broken.end();
  });
  if (more.empty()) return listing;
  measure::Listing compilers = measure::list_compilers(more);
  if (!request.devices.empty()) compilers.devices.clear();
  measure::append(listing, std::move(compilers));
  return listing;
}

// Measures the plans in two groups, because plans that only compile use different devices than
// plans that draw.
std::vector<measure::RunResult> measure_each(const MeasureRequest& request,
                                             const Registry& registry,
                                             const std::vector<measure::Plan>& plans,
                                             const measure::Listing& listing,
                                             record::Store& store) {
  std::vector<measure::RunResult> results(plans.size());
  for (const bool compiled : {false, true}) {
    std::vector<measure::Plan> group;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < plans.size(); ++i) {
      if (plans[i].compiled() != compiled) continue;
      group.push_back(plans[i]);
      places.push_back(i);
    }
    if (group.empty()) continue;
    const RunContext context{request, registry, devices_of(listing, request.devices, compiled),
                             beginning_of(listing, request), store};
    if (context.devices.empty()) {
      std::string missing;
      for (const measure::Broken& each : listing.broken) {
        if (measure::compile_only(each.what)) {
          missing += fmt::format("; {}: {}", each.what, each.reason);
        }
      }
      throw core::NotSupported(fmt::format("{}: no GPU compiler is available on this machine{}",
                                           group.front().name, missing));
    }
    std::vector<measure::RunResult> measured = measure_on(context, group);
    for (std::size_t i = 0; i < places.size(); ++i) results[places[i]] = std::move(measured[i]);
  }
  return results;
}

}  // namespace

MeasureResult measure_and_print(const MeasureRequest& request) {
  const Registry registry = make_registry();
  const std::vector<measure::Plan> plans = load_plans(request, registry);
  const measure::Listing listing = listing_for(request, registry, plans);
  core::require_writable(std::filesystem::path(request.store).parent_path());
  record::Store store(request.store, record::Store::Mode::append);
  const RunContext context{request, registry,
                           devices_of(listing, request.devices, plans.front().compiled()),
                           beginning_of(listing, request), store};
  if (request.error) return measure_within_error(context, plans.front());
  MeasureResult measured{.results = measure_each(request, registry, plans, listing, store)};
  for (std::size_t i = 0; request.report_fastest && i < plans.size(); ++i) {
    print_fastest(context, plans[i], measured.results[i].run);
  }
  measured.scored = std::ranges::any_of(
      plans, [](const measure::Plan& plan) { return plan.checks.contains(record::Check::stress); });
  return measured;
}

MeasureResult measure_resumably(const MeasureRequest& request) {
  try {
    return measure_and_print(request);
  } catch (const measure::Interrupted& interrupted) {
    throw measure::Interrupted(
        interrupted.signal(),
        "interrupted; the records so far are in the store; use --resume to continue");
  }
}

}  // namespace triptych::app
