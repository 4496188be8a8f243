#include "measure/run/runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include "measure/protocol/injected_fault.hpp"
#include "measure/run/new_run.hpp"
#include "measure/run/plan_run.hpp"
#include "measure/system/environment.hpp"
#include "measure/system/interrupt.hpp"

namespace triptych::measure {
namespace {

// Returns the kinds of work for which clocks and statistics have to be calibrated.
std::vector<std::string> kinds_of(const Plan& plan, const Protocol& protocol) {
  const bool needs_clock = protocol.timed || protocol.statistics;
  return plan.timed() && needs_clock ? work_kinds(plan) : std::vector<std::string>{};
}

// Returns whether frames are timed: both the plan and the options must ask for it.
bool is_timed(const Plan& plan, const RunOptions& options) {
  return plan.timed() && options.protocol.timed;
}

// Throws InputError if the run that is to be resumed contains a configuration that the plan does
// not contain. This can happen because the run is found only by the plan's name, and the plan may
// have changed since the run began.
void refuse_another_plan(const record::Run& run, const Plan& plan, const Suite& suite,
                         const record::Store& store) {
  if (run.plan_hash == plan.hash) return;
  std::set<std::string> keys;
  for (const Configuration& each : plan.configurations) {
    keys.insert(configuration_key(suite, each));
  }
  for (const record::Record& record : store.records(run.id)) {
    if (keys.contains(record.configuration)) continue;
    throw core::InputError(fmt::format(
        "cannot resume run {} of plan {}: the run contains {}, which is not in this plan "
        "(the plan has changed, or a different plan has the same name); omit --resume to "
        "start a new run",
        run.id, plan.name, record.configuration));
  }
}

// Returns the id of the run to which records are to be added: the plan's latest run if it is
// resumed, or else a new run. Stores the planned configurations before anything is measured.
std::string open_run(const PlannedRun& planned, const std::vector<std::string>& devices,
                     record::Store& store) {
  const auto& [plan, suite, options] = planned;
  record::Run run = new_run(plan, options.program);
  if (options.resume) {
    const record::Run found = store.latest_run_or_add(run);
    if (found.id != run.id) refuse_another_plan(found, plan, suite, store);
    run = found;
  } else {
    store.add_run(run);
  }
  record::RunStart begun = options.begun;
  begun.program = options.program;
  begun.devices = devices;
  if (begun.found.empty()) begun.found = devices;
  std::vector<std::string> keys;
  keys.reserve(plan.configurations.size());
  for (const Configuration& each : plan.configurations) {
    keys.push_back(configuration_key(suite, each));
  }
  store.begin(run.id, begun, keys);
  return run.id;
}

void refuse_bad_options(const RunOptions& options) {
  if (const auto reason = reason_not_to_measure()) throw core::InputError(*reason);
  if (const auto reason = reason_not_to_measure(options.worker_environment)) {
    throw core::InputError(*reason);
  }
  for (const InjectedFault& each : options.faults) check_fault(each.fault);
}

// Combines the progress of the parts of a run that are measured in parallel: adds up the numbers of
// configurations, and reports the longest remaining time of any part.
class JointProgress {
 public:
  explicit JointProgress(const PlanRun::OnProgress& on_progress) : on_progress_(on_progress) {}

  void add(std::size_t part, Progress progress) {
    const std::scoped_lock lock(mutex_);
    if (!on_progress_) return;
    if (!progress.loading) parts_[part] = {progress.done, progress.total, progress.left};
    progress.done = progress.total = 0;
    progress.left = {};
    for (const auto& [number, each] : parts_) {
      progress.done += each.done;
      progress.total += each.total;
      progress.left = std::max(progress.left, each.left);
    }
    on_progress_(progress);
  }

 private:
  struct Part {
    int done;
    int total;
    std::chrono::seconds left;
  };
  const PlanRun::OnProgress& on_progress_;
  std::mutex mutex_;
  std::map<std::size_t, Part> parts_;
};

void add(const RunResult& part, RunResult& sum) {
  sum.measured += part.measured;
  sum.copied += part.copied;
  sum.skipped += part.skipped;
  sum.failed += part.failed;
  sum.already_stored += part.already_stored;
  sum.devices_ns += part.devices_ns;
  sum.overhead_ns += part.overhead_ns;
}

// A part of a run that is measured on one device.
struct Part {
  const RunContext* context;
  std::string device;
};

// Measures parts in parallel. This function is used only if nothing is timed, because parallel
// parts would disturb each other's times. Each part has its own connection to the store. If a part
// fails, the first error is thrown after all running parts have ended.
std::vector<RunResult> measure_in_parallel(const std::vector<Part>& parts,
                                           std::size_t most_in_parallel,
                                           const PlanRun::OnProgress& on_progress) {
  JointProgress joint(on_progress);
  std::vector<RunResult> results(parts.size());
  std::mutex mutex;
  std::exception_ptr failure;
  std::size_t next = 0;
  const auto run_parts = [&] {
    for (;;) {
      std::unique_lock lock(mutex);
      if (failure || next == parts.size()) return;
      const std::size_t number = next++;
      lock.unlock();
      const auto& [context, device] = parts[number];
      const PlanRun::OnProgress report_part = [&](const Progress& progress) {
        joint.add(number, progress);
      };
      try {
        record::Store store(context->store.file(), record::Store::Mode::append);
        const RunContext own{context->plan,       context->suite, store,         context->options,
                             context->interrupts, context->run,   context->kinds};
        results[number] = PlanRun(own, {device}, report_part).measure_all();
      } catch (...) {
        lock.lock();
        if (!failure) failure = std::current_exception();
      }
    }
  };
  const std::size_t thread_count = std::min(parts.size(), most_in_parallel);
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < thread_count; ++i) threads.emplace_back(run_parts);
  }
  if (failure) std::rethrow_exception(failure);
  return results;
}

std::size_t processors() {
  return std::max(1U, std::thread::hardware_concurrency());
}

// Divides a plan into parts, none of which is empty. Each part consists of pieces from all over the
// plan. In this way, all parts take about the same time, although neighbouring configurations are
// similar. Each piece consists of neighbouring configurations, so that they can share their data.
std::vector<Plan> parts_of(const Plan& plan, std::size_t count) {
  constexpr std::size_t pieces_per_part = 8;
  constexpr std::size_t longest_piece = 16;
  const std::size_t all = plan.configurations.size();
  const std::size_t piece =
      std::clamp<std::size_t>(all / (count * pieces_per_part), 1, longest_piece);
  Plan empty_part = plan;
  empty_part.configurations.clear();
  std::vector<Plan> parts(count, empty_part);
  for (std::size_t i = 0; i < all; ++i) {
    parts[i / piece % count].configurations.push_back(plan.configurations[i]);
  }
  std::erase_if(parts, [](const Plan& part) { return part.configurations.empty(); });
  return parts;
}

RunResult measure_devices_in_parallel(const RunContext& context,
                                      const std::vector<std::string>& devices,
                                      const PlanRun::OnProgress& on_progress) {
  const Stopwatch stopwatch;
  const auto jobs = static_cast<std::size_t>(context.options.jobs);
  // In a plan that only compiles, two workers divide the configurations of each device, because the
  // slowest compiler would otherwise run alone at the end. The number does not depend on the
  // machine, because some statistics of radeonsi depend on what the process compiled before.
  const std::size_t workers_per_device = context.plan.compiled() ? 2 : 1;
  const std::vector<Plan> plans = parts_of(context.plan, std::max(jobs, workers_per_device));
  std::vector<RunContext> contexts;
  contexts.reserve(plans.size());
  for (const Plan& plan : plans) {
    contexts.push_back({plan, context.suite, context.store, context.options, context.interrupts,
                        context.run, context.kinds});
  }
  std::vector<Part> parts;
  for (const std::string& device : devices) {
    for (const RunContext& each : contexts) parts.push_back({&each, device});
  }
  const std::size_t most_in_parallel = jobs > 0 ? jobs : processors();
  RunResult sum;
  for (const RunResult& part : measure_in_parallel(parts, most_in_parallel, on_progress))
    add(part, sum);
  sum.run = context.run;
  sum.wall_ns = stopwatch.ns();
  return sum;
}

}  // namespace

std::vector<RunResult> run_plans(std::span<const PlannedRun> runs,
                                 const std::vector<std::string>& devices, record::Store& store,
                                 const std::function<void(const Progress&)>& on_progress) {
  for (const PlannedRun& each : runs) refuse_bad_options(each.options);
  InterruptGuard interrupts;
  std::vector<RunResult> results;
  results.reserve(runs.size());
  for (const PlannedRun& each : runs) {
    const auto& [plan, suite, options] = each;
    const RunContext context{plan,
                             suite,
                             store,
                             options,
                             interrupts,
                             open_run(each, devices, store),
                             kinds_of(plan, options.protocol)};
    const bool in_parallel =
        !is_timed(plan, options) && (devices.size() > 1 || options.jobs > 1 || plan.compiled());
    results.push_back(in_parallel ? measure_devices_in_parallel(context, devices, on_progress)
                                  : PlanRun(context, devices, on_progress).measure_all());
  }
  return results;
}

std::array<RunResult, 2> run_sides(const SidesRun& sides, record::Store& store,
                                   const std::function<void(const Progress&)>& on_progress) {
  InterruptGuard interrupts;
  std::vector<RunContext> contexts;
  std::vector<Part> parts;
  contexts.reserve(sides.options.size());
  for (std::size_t i = 0; i < sides.options.size(); ++i) {
    const PlannedRun planned{sides.plan, sides.suite, sides.options[i]};
    refuse_bad_options(planned.options);
    contexts.push_back({planned.plan, planned.suite, store, planned.options, interrupts,
                        open_run(planned, {sides.devices[i]}, store),
                        kinds_of(planned.plan, planned.options.protocol)});
    parts.push_back({&contexts.back(), sides.devices[i]});
  }
  const bool timed = std::ranges::any_of(
      sides.options, [&](const RunOptions& options) { return is_timed(sides.plan, options); });
  if (!timed) {
    std::vector<RunResult> results = measure_in_parallel(parts, processors(), on_progress);
    return {std::move(results[0]), std::move(results[1])};
  }
  std::array<RunResult, 2> results;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    results[i] = PlanRun(contexts[i], {parts[i].device}, on_progress).measure_all();
  }
  return results;
}

std::string describe(const RunResult& result, const std::string& plan, const std::string& store) {
  std::string text = fmt::format(
      "{}: run {} in {}: {} measured, {} skipped, {} failed; {:.1f} s, {:.1f} % overhead outside "
      "drivers and devices\n",
      plan, result.run, store, result.measured, result.skipped, result.failed, result.wall_ns / 1e9,
      result.devices_ns > 0 ? 100 * result.overhead_ns / result.devices_ns : 0.0);
  if (result.already_stored > 0) {
    text += fmt::format("{} of these results were already in the store\n", result.already_stored);
  }
  if (result.copied > 0) {
    text += fmt::format(
        "{} of these results reuse the frames of an equivalent configuration; to measure every "
        "configuration, use --measure-every\n",
        result.copied);
  }
  return text;
}

std::vector<InjectedFault> unmatched_faults(std::span<const PlannedRun> runs,
                                            const std::vector<std::string>& devices) {
  const auto hits = [&](const InjectedFault& fault, const PlannedRun& run) {
    return std::ranges::any_of(run.plan.configurations, [&](const Configuration& each) {
      const std::string key = configuration_key(run.suite, each);
      return std::ranges::any_of(devices, [&](const std::string& device) {
        return !faults_for({&fault, 1}, key, device).empty();
      });
    });
  };
  std::vector<InjectedFault> missing;
  if (runs.empty()) return missing;
  std::ranges::copy_if(
      runs.front().options.faults, std::back_inserter(missing), [&](const InjectedFault& fault) {
        return std::ranges::none_of(runs, [&](const PlannedRun& run) { return hits(fault, run); });
      });
  return missing;
}

RunResult run_plan(const Plan& plan, const std::vector<std::string>& devices, const Suite& suite,
                   record::Store& store, const RunOptions& options,
                   const std::function<void(const Progress&)>& on_progress) {
  const PlannedRun planned{plan, suite, options};
  return std::move(run_plans({&planned, 1}, devices, store, on_progress).front());
}

}  // namespace triptych::measure
