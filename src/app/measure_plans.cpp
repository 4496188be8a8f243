#include "app/measure_plans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "app/registry.hpp"
#include "app/terminal.hpp"
#include "app/version.hpp"
#include "core/glob.hpp"
#include "core/output_files.hpp"
#include "measure/request/error_request.hpp"
#include "measure/request/fastest.hpp"
#include "measure/system/compile_only.hpp"
#include "measure/system/system_facts.hpp"
#include "measure/worker/listing.hpp"
#include "measure/worker/own_program.hpp"
#include "report/screen/progress_log.hpp"

namespace triptych::app {
namespace {

void write_raw(const std::string& text) {
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
}

// Prints the progress of a measurement to a log or a terminal.
class ProgressPrinter {
 public:
  explicit ProgressPrinter(const Measuring& measuring)
      : log_({.width = columns(), .verbose = measuring.verbose}) {}

  void print(const measure::Progress& progress) {
    if (progress.loading) {
      if (!progress.loading->note.empty()) return show_note(*progress.loading);
      return write_raw(log_.loading(progress.loading->what, progress.loading->share));
    }
    if (progress.record != nullptr) plan_ = progress.record->plan;
    write_raw(log_.next({.plan = plan_,
                         .device = progress.device,
                         .done = progress.done,
                         .total = progress.total,
                         .left = progress.left,
                         .record = progress.record}));
  }
  void end() { write_raw(log_.end()); }

 private:
  report::ProgressLog log_;
  std::string plan_;
};

// Rejects options that apply to a single plan if several plans are named: --set, because its
// factors belong to one suite, and --error, because it is computed for the scenes of one plan.
void refuse_for_several(const Measuring& measuring) {
  if (measuring.plans.size() < 2) return;
  if (!measuring.choice.set.empty()) {
    throw core::InputError(
        "--set applies to a single plan; name one plan, or write a YAML file for each plan");
  }
  if (measuring.error) throw core::InputError("--error applies to a single plan; name one plan");
}

std::vector<measure::Plan> load_plans(const Measuring& measuring, const Registry& registry) {
  refuse_for_several(measuring);
  std::vector<measure::Plan> plans;
  for (const std::string& name : measuring.plans) {
    measure::Plan plan = measuring.choice.load(name, registry.find_suite());
    if (std::ranges::find(plans, plan.name, &measure::Plan::name) != plans.end()) {
      throw core::InputError(
          fmt::format("two plans are named {}; rename one of them, because runs are identified by "
                      "the plan's name",
                      plan.name));
    }
    if (plan.configurations.empty() && measuring.choice.selects()) continue;
    const bool chooses = measuring.chooses && !plan.automatic.empty();
    if (chooses && measuring.untimed && !plan.counted()) {
      throw core::InputError(
          fmt::format("{}: technique=auto needs frame times; remove --untimed", plan.name));
    }
    if ((measuring.timed || chooses) && !plan.counted()) {
      plan.checks.insert(record::Check::timing);
    }
    plans.push_back(std::move(plan));
  }
  if (plans.empty()) throw nothing_selected(measuring.choice);
  return plans;
}

measure::RunOptions options_of(const Measuring& measuring, const record::Beginning& begun) {
  measure::Protocol protocol = measuring.brief ? measure::brief_protocol : measure::Protocol{};
  protocol.timed = !measuring.untimed;
  protocol.statistics = protocol.timed || measuring.statistics;
  protocol.measure_every = measuring.measure_every;
  std::vector<std::string> more;
  if (measuring.memory) more = {"--memory", fmt::to_string(*measuring.memory)};
  return {.protocol = protocol,
          .limit = std::chrono::seconds(measuring.limit_s),
          .resume = measuring.resume,
          .again = measuring.again,
          .faults = measure::parse_faults(measuring.faults),
          .jobs = measuring.jobs,
          .worker_command = measure::worker_command(measure::own_program(), more),
          .begun = begun,
          .program = version()};
}

// The devices on which plans are measured, and the store that receives the records.
struct Bench {
  const Measuring& measuring;
  const Registry& registry;
  std::vector<std::string> devices;
  record::Beginning begun;
  record::Store& store;
};

// Returns the state at the beginning of the run: the host, and the requested, found and unusable
// devices. GPU families whose compiler is not installed are recorded only if the user named a GPU
// family or requires the device.
record::Beginning begun_with(const measure::Listing& listing, const Measuring& measuring) {
  record::Beginning begun{.host = measure::host_name(), .asked = measuring.devices};
  const bool named = measure::name_a_compiler(measuring.devices);
  const auto is_required = [&](const std::string& id) {
    return core::any_glob_matches(measuring.required, id);
  };
  for (const record::Device& each : listing.devices) begun.found.push_back(each.id);
  for (const measure::Broken& each : listing.broken) {
    if (!named && measure::compile_only(each.what) && !is_required(each.what)) continue;
    begun.unusable.push_back({each.what, each.reason, each.ended});
  }
  return begun;
}

std::vector<measure::RunResult> measure_on(const Bench& bench,
                                           const std::vector<measure::Plan>& plans) {
  const measure::RunOptions options = options_of(bench.measuring, bench.begun);
  std::vector<measure::PlannedRun> runs;
  runs.reserve(plans.size());
  for (const measure::Plan& plan : plans) {
    runs.push_back({plan, bench.registry.suite(plan.suite), options});
  }
  ProgressPrinter printer(bench.measuring);
  std::vector<measure::RunResult> results;
  try {
    const LogSection section(bench.measuring.ci, "Measuring");
    results =
        measure::run_plans(runs, bench.devices, bench.store,
                           [&](const measure::Progress& progress) { printer.print(progress); });
    printer.end();
  } catch (...) {
    printer.end();
    throw;
  }
  for (const auto& [fault, only] : measure::faults_that_hit_nothing(runs, bench.devices)) {
    say("triptych: --inject {}@{} has no effect, because no configuration or device matches; "
        "`triptych list PLAN` prints the names of configurations, which omit default levels\n",
        fault, only);
  }
  for (std::size_t i = 0; i < plans.size(); ++i) {
    put_lines(describe(results[i], plans[i].name, bench.measuring.store), bench.measuring.told_to);
  }
  return results;
}

// Measures the configurations that meet the requested error, and finds the fastest configuration
// for each scene and device.
Measured measure_within_error(const Bench& bench, const measure::Plan& plan) {
  const auto wanted = accuracy::parse_requested_error(*bench.measuring.error);
  measure::SuiteWithTruth& suite = bench.registry.suite(plan.suite);
  measure::Truths truths(bench.registry.find_suite(), bench.store);
  const measure::ErrorRequest request = measure::request_error(
      plan, suite, wanted, truths, [](const std::string& what) { say("{}\n", what); });
  Measured measured{.error_kept = request.out_of_reach.empty()};
  std::vector<record::Record> records;
  if (!request.plan.configurations.empty()) {
    measured.results = measure_on(bench, {request.plan});
    records = bench.store.records(measured.results.front().run);
  }
  for (const measure::ErrorAnswer& answer : measure::answer_error(records, suite, wanted, truths)) {
    put_lines(describe(answer, wanted) + "\n");
    measured.error_kept = measured.error_kept && answer.record != nullptr;
  }
  for (const std::string& scene : request.out_of_reach) put("{}\n", scene);
  return measured;
}

void tell_the_fastest(const Bench& bench, const measure::Plan& plan, const std::string& run) {
  if (plan.automatic.empty()) return;
  const std::vector<record::Record> records = bench.store.records(run);
  for (const measure::FastestAnswer& answer :
       measure::answer_fastest(records, bench.registry.suite(plan.suite), plan.automatic)) {
    put_lines(describe(answer, plan.automatic) + "\n");
  }
}

// Returns the devices on which plans are measured. Plans with the check `code` (`compiled`) are
// measured on GPUs and on devices that only compile code (for a GPU that is not present), but not
// on CPU devices, because the plans with the check `cost` already count the instructions of CPU
// devices. All other plans are measured on all devices except those that only compile.
std::vector<std::string> devices_of(const measure::Listing& listing,
                                    const std::vector<std::string>& globs, bool compiled) {
  std::vector<std::string> chosen = measure::choose_devices(listing, globs);
  std::vector<std::string> fit;
  for (const std::string& id : chosen) {
    const auto device = std::ranges::find(listing.devices, id, &record::Device::id);
    const bool fits = compiled ? device->cpu_features.empty() : device->compiles_for.empty();
    if (fits) fit.push_back(id);
  }
  // If the user names only unsuitable devices, they are returned nevertheless, so that each of them
  // is recorded as skipped with a reason.
  if (fit.empty() && !globs.empty()) return chosen;
  return fit;
}

measure::Listing listing_for(const Measuring& measuring, const Registry& registry,
                             const std::vector<measure::Plan>& plans) {
  const bool compiled = std::ranges::any_of(plans, &measure::Plan::compiled);
  if (!compiled && !measure::name_a_compiler(measuring.devices)) {
    return registry.devices(measuring.devices);
  }
  measure::Listing listing = registry.devices_and_compilers(measuring.devices);
  // Adds the required devices that only compile and are not yet listed: they may match no glob in
  // `devices`, and they need not be among the usual devices that devices_and_compilers() lists.
  std::vector<std::string> more = measuring.required;
  std::erase_if(more, [&](const std::string& id) {
    return !measure::compile_only(id) ||
           std::ranges::find(listing.devices, id, &record::Device::id) != listing.devices.end() ||
           std::ranges::find(listing.broken, id, &measure::Broken::what) != listing.broken.end();
  });
  if (more.empty()) return listing;
  measure::Listing compilers = measure::list_compilers(more);
  if (!measuring.devices.empty()) compilers.devices.clear();
  measure::append(listing, std::move(compilers));
  return listing;
}

// Measures the plans in two groups, because plans that only compile use different devices than
// plans that draw.
std::vector<measure::RunResult> measure_each(const Measuring& measuring, const Registry& registry,
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
    const Bench bench{measuring, registry, devices_of(listing, measuring.devices, compiled),
                      begun_with(listing, measuring), store};
    if (bench.devices.empty()) {
      std::string missing;
      for (const measure::Broken& each : listing.broken) {
        if (measure::compile_only(each.what)) {
          missing += fmt::format("; {}: {}", each.what, each.reason);
        }
      }
      throw core::NotSupported(fmt::format("{}: no GPU compiler is available on this machine{}",
                                           group.front().name, missing));
    }
    std::vector<measure::RunResult> measured = measure_on(bench, group);
    for (std::size_t i = 0; i < places.size(); ++i) results[places[i]] = std::move(measured[i]);
  }
  return results;
}

}  // namespace

Measured measure_and_tell(const Measuring& measuring) {
  const Registry registry = make_registry();
  const std::vector<measure::Plan> plans = load_plans(measuring, registry);
  const measure::Listing listing = listing_for(measuring, registry, plans);
  core::require_writable(std::filesystem::path(measuring.store).parent_path());
  record::Store store(measuring.store, record::Store::Mode::append);
  const Bench bench{measuring, registry,
                    devices_of(listing, measuring.devices, plans.front().compiled()),
                    begun_with(listing, measuring), store};
  if (measuring.error) return measure_within_error(bench, plans.front());
  Measured measured{.results = measure_each(measuring, registry, plans, listing, store)};
  for (std::size_t i = 0; measuring.chooses && i < plans.size(); ++i) {
    tell_the_fastest(bench, plans[i], measured.results[i].run);
  }
  measured.scored = std::ranges::any_of(
      plans, [](const measure::Plan& plan) { return plan.checks.contains(record::Check::stress); });
  return measured;
}

Measured measure_resumably(const Measuring& measuring) {
  try {
    return measure_and_tell(measuring);
  } catch (const measure::Interrupted& interrupted) {
    throw measure::Interrupted(
        interrupted.signal(),
        "interrupted; the records so far are in the store; use --resume to continue");
  }
}

}  // namespace triptych::app
