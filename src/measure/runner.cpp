#include "measure/runner.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <deque>
#include <optional>
#include <random>
#include <set>
#include <utility>

#include "measure/environment.hpp"
#include "measure/interrupt.hpp"
#include "measure/plan_run.hpp"
#include "measure/plant.hpp"
#include "measure/stopwatch.hpp"

namespace triptych::measure {
namespace {

std::string utc_now(const char* format) {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format(fmt::runtime(fmt::format("{{:{}}}", format)), fmt::gmtime(now));
}

constexpr const char* hash_fact = "plan hash";  // in record::Run::system

record::Run new_run(const Plan& plan) {
  std::random_device entropy;
  auto facts = system_facts();
  if (!plan.hash.empty()) facts[hash_fact] = plan.hash;
  return {.id = fmt::format("{}-{:08x}", utc_now("%Y%m%dT%H%M%SZ"), entropy()),
          .plan = plan.name,
          .started_at = utc_now("%Y-%m-%dT%H:%M:%SZ"),
          .system = std::move(facts),
          .plan_hash = plan.hash,
          .configurations = plan.configurations.size()};
}

// The kinds of work whose clocks are needed.
std::vector<std::string> kinds_of(const Plan& plan, const Protocol& protocol) {
  return plan.timed && protocol.timed ? work_kinds(plan) : std::vector<std::string>{};
}

// A file's runs are known by its name alone. Where its text is not the one that a run began with,
// the run must hold nothing that the plan would not measure now.
void refuse_another_plan(const record::Run& run, const Plan& plan, const Suite& suite,
                         const record::Store& store) {
  const auto hash = run.system.find(hash_fact);
  if (hash == run.system.end() || hash->second == plan.hash) return;
  std::set<std::string> keys;
  for (const Configuration& each : plan.configurations) {
    keys.insert(configuration_key(suite, each));
  }
  for (const record::Record& record : store.records(run.id)) {
    if (keys.contains(record.configuration)) continue;
    throw core::InputError(
        fmt::format("run {} of {} holds {}, which this plan does not measure: it has changed since "
                    "or is another of that name; without --resume it begins a run of its own",
                    run.id, plan.name, record.configuration));
  }
}

// The id of the run to add to: a new one, or the plan's latest when it is to be resumed.
std::string open_run(const PlannedRun& planned, record::Store& store) {
  const auto& [plan, suite, options] = planned;
  const auto latest = store.latest_run(plan.name);
  if (options.resume && latest) {
    refuse_another_plan(*latest, plan, suite, store);
    return latest->id;
  }
  record::Run run = new_run(plan);
  if (options.confirm && latest) run.confirms = latest->id;
  store.add_run(run);
  return run.id;
}

void refuse_bad_options(const RunOptions& options) {
  if (const auto reason = forbids_measuring()) throw core::InputError(*reason);
  for (const Plant& plant : options.plants) check_plant(plant.fault);
}

}  // namespace

std::vector<RunResult> run_plans(std::span<const PlannedRun> runs,
                                 const std::vector<std::string>& devices, record::Store& store,
                                 const std::function<void(const Progress&)>& on_progress) {
  const Stopwatch run;
  for (const PlannedRun& each : runs) refuse_bad_options(each.options);
  InterruptGuard interrupts;
  std::deque<RunContext> contexts;  // each PlanRun refers to its own
  std::deque<PlanRun> all;
  for (const PlannedRun& each : runs) {
    const auto& [plan, suite, options] = each;
    contexts.push_back({plan, suite, store, options, interrupts, open_run(each, store),
                        kinds_of(plan, options.protocol)});
    all.emplace_back(contexts.back(), devices, on_progress).first_round();
  }
  std::size_t most = 1;
  for (const PlanRun& each : all) most = std::max(most, each.most_rounds());
  for (std::size_t round = 2; round <= most; ++round) {
    for (PlanRun& each : all) each.further_round(round, run);
  }
  std::vector<RunResult> results;
  results.reserve(all.size());
  for (PlanRun& each : all) results.push_back(each.conclude());
  return results;
}

RunResult run_plan(const Plan& plan, const std::vector<std::string>& devices, const Suite& suite,
                   record::Store& store, const RunOptions& options,
                   const std::function<void(const Progress&)>& on_progress) {
  const PlannedRun alone{plan, suite, options};
  return std::move(run_plans({&alone, 1}, devices, store, on_progress).front());
}

}  // namespace triptych::measure
