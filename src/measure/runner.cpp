#include "measure/runner.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <string_view>
#include <utility>

#include "measure/device_run.hpp"
#include "measure/environment.hpp"
#include "measure/interrupt.hpp"
#include "measure/plant.hpp"
#include "measure/rounds.hpp"
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
          .system = std::move(facts)};
}

// The kinds of work whose clocks are needed.
std::vector<std::string> kinds_of(const Plan& plan, const Protocol& protocol) {
  return plan.timed && protocol.timed ? work_kinds(plan) : std::vector<std::string>{};
}

void count(const record::Record& record, RunResult& result) {
  switch (record.outcome) {
    case record::Outcome::measured:
      ++result.measured;
      if (!record.same_as.empty()) ++result.taken_over;
      break;
    case record::Outcome::skipped:
      ++result.skipped;
      break;
    case record::Outcome::failed:
    case record::Outcome::crashed:
    case record::Outcome::hung:
    case record::Outcome::lost:
      ++result.failed;
      break;
  }
}

// What frames of another configuration told, which were this one's too; its own benchmark's entry
// there is none.
void take_over(record::Record& record, const record::Record& measured) {
  record.wall_ns = measured.wall_ns;
  record.device_ns = measured.device_ns;
  record.device_clock_trusted = measured.device_clock_trusted;
  record.warm_up_frames = measured.warm_up_frames;
  record.frames_per_100ms = measured.frames_per_100ms;
  record.rounds_ns = measured.rounds_ns;
  record.loop_wall_ns = measured.loop_wall_ns;
  record.loop_frames = measured.loop_frames;
  record.counters = measured.counters;
  record.statistics = measured.statistics;
  record.image = measured.image;
  record.data_hash = measured.data_hash;
  record.kernel_hash = measured.kernel_hash;
  record.precision = measured.precision;
}

// Tells how far the run is, with the time left as the mean of what was done foretells it.
class Report {
 public:
  Report(int round, std::size_t total, const std::function<void(const Progress&)>& tell)
      : round_(round), total_(static_cast<int>(total)), tell_(tell) {}

  void already_done() { --total_; }

  void done(const record::Record& record) {
    ++done_;
    if (!tell_) return;
    const auto spent = since_.elapsed();
    const auto left = spent / done_ * (total_ - done_);
    tell_({.device = record.device,
           .configuration = record.configuration,
           .round = round_,
           .done = done_,
           .total = total_,
           .left = std::chrono::round<std::chrono::seconds>(left),
           .record = &record,
           .loading = {}});
  }

  void loading(const std::string& device, const std::string& key, const Loading& loading) {
    if (!tell_) return;
    tell_({.device = device,
           .configuration = key,
           .round = round_,
           .done = done_,
           .total = total_,
           .left = {},
           .record = nullptr,
           .loading = loading});
  }

 private:
  int round_;
  int total_;
  int done_ = 0;
  const std::function<void(const Progress&)>& tell_;
  Stopwatch since_;
};

// The work of a device that a resumed run has not done yet.
std::vector<const Configuration*> pending(const RunContext& context, const std::string& device,
                                          Report& report) {
  std::vector<const Configuration*> result;
  for (const Configuration& configuration : context.plan.configurations) {
    const bool done = context.options.resume &&
                      context.store.has_record(
                          context.run, configuration_key(context.suite, configuration), device);
    if (done) {
      report.already_done();
    } else {
      result.push_back(&configuration);
    }
  }
  return result;
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

// One run, from the first configuration to the last round.
class Measuring {
 public:
  Measuring(const RunContext& context, const std::vector<std::string>& devices,
            const std::function<void(const Progress&)>& tell)
      : context_(context), devices_(devices), tell_(tell) {
    result_.run = context.run;
    for (const Configuration& configuration : context.plan.configurations) {
      by_key_[configuration_key(context.suite, configuration)] = &configuration;
    }
    if (context.options.resume) count_what_is_there();
  }

  // Everything once, by the whole protocol.
  void first_round() {
    const Stopwatch stopwatch;
    Report report(1, context_.plan.configurations.size() * devices_.size(), tell_);
    std::vector<std::pair<std::string, std::vector<const Configuration*>>> work;
    work.reserve(devices_.size());
    for (const std::string& device : devices_) {
      work.emplace_back(device, pending(context_, device, report));
    }
    for (const auto& [device, configurations] : work) {
      for (const Configuration* configuration : configurations) {
        measure(device, *configuration, report);
      }
      if (most_rounds() == 1) leave(device);
    }
    if (most_rounds() > 1) remember_records();
    result_.wall_ns += stopwatch.ns();
  }

  // The timed frames again, of what is not settled; `run` is the time since the first round began.
  void further_round(std::size_t round, const Stopwatch& run) {
    if (round > most_rounds()) return;
    const Stopwatch stopwatch;
    const auto& budget = context_.options.budget;
    const auto order = budget ? RoundOrder::doubtful_first : RoundOrder::as_measured;
    const std::vector<std::size_t> chosen = next_round(records_, most_rounds(), order);
    Report report(static_cast<int>(round), chosen.size(), tell_);
    for (const std::size_t each : chosen) {
      if (budget && run.elapsed() >= *budget) break;
      once_more(records_[each], report);
    }
    result_.wall_ns += stopwatch.ns();
  }

  [[nodiscard]] std::size_t most_rounds() const {
    constexpr std::size_t most_within_budget = 32;
    if (!context_.plan.timed || !context_.options.protocol.timed) return 1;
    if (context_.options.rounds) return static_cast<std::size_t>(*context_.options.rounds);
    return context_.options.budget ? most_within_budget
                                   : static_cast<std::size_t>(context_.plan.rounds);
  }

  [[nodiscard]] RunResult conclude() {
    const Stopwatch stopwatch;
    while (!open_.empty()) leave(open_.begin()->first);
    result_.unsettled =
        static_cast<int>(std::ranges::count_if(records_, [](const record::Record& record) {
          return record.outcome == record::Outcome::measured && !is_settled(record);
        }));
    result_.wall_ns += stopwatch.ns();
    result_.overhead_ns = result_.wall_ns - work_ns_;
    return std::move(result_);
  }

 private:
  DeviceRun& on(const std::string& device) {
    auto& entry = open_[device];
    if (!entry) entry = std::make_unique<DeviceRun>(context_, device);
    return *entry;
  }

  void leave(const std::string& device) {
    const auto entry = open_.find(device);
    if (entry == open_.end()) return;
    entry->second->finish();
    work_ns_ += entry->second->opening_ns();
    open_.erase(entry);
  }

  void stop_if_asked() {
    if (const auto signal = context_.interrupts.take()) throw Interrupted(*signal);
  }

  void measure(const std::string& device, const Configuration& configuration, Report& report) {
    stop_if_asked();
    const std::string key = configuration_key(context_.suite, configuration);
    Done done = attempt(device, configuration, key, report);
    if (done.record.outcome == record::Outcome::measured) share_frames(done.record);
    // The image first: a record must never name one that is not there.
    if (!done.exr.empty()) context_.store.add_image(done.record.image, done.exr);
    context_.store.add_record(done.record);
    work_ns_ += done.work_ns;
    count(done.record, result_);
    report.done(done.record);
  }

  // A driver may take the machine with it, and would again with each --resume.
  Done attempt(const std::string& device, const Configuration& configuration,
               const std::string& key, Report& report) {
    constexpr int most_attempts = 2;
    if (context_.store.begin_record(context_.run, key, device) > most_attempts) {
      return on(device).pass_by(
          configuration, key,
          {record::Outcome::crashed,
           fmt::format("{} times all ended while this was under way, triptych or the machine; a "
                       "run without --resume tries again",
                       most_attempts)});
    }
    try {
      return on(device).perform(configuration, key, [&](const Loading& loading) {
        report.loading(device, key, loading);
      });
    } catch (...) {  // an end that is known, and no fault of the configuration
      context_.store.unbegin_record(context_.run, key, device);
      throw;
    }
  }

  // A record of other frames tells what they told; one of its own may have to tell others.
  void share_frames(record::Record& record) {
    if (record.same_as.empty()) {
      record::Record& kept = measured_[{record.device, record.configuration}];
      kept = record;
      kept.benchmark_json.clear();  // the largest part, and never taken over
    } else {
      take_over(record, measured_.at({record.device, record.same_as}));
    }
  }

  // Those that took over its frames have its further rounds too, whether or not the plan holds
  // them; at once, so that a run that is stopped leaves none behind.
  void share_rounds(const record::Record& measured) {
    for (record::Record& twin : twins_) {
      const bool of_it = twin.device == measured.device && twin.same_as == measured.configuration;
      if (!of_it || twin.rounds_ns == measured.rounds_ns) continue;
      take_over(twin, measured);
      context_.store.update_times(twin);
    }
  }

  // Of the plan, on the run's devices: what it is resumed with may be less than it began with.
  [[nodiscard]] bool is_ours(const record::Record& record) const {
    return is_on_our_devices(record) && by_key_.contains(record.configuration);
  }

  [[nodiscard]] bool is_on_our_devices(const record::Record& record) const {
    return std::ranges::find(devices_, record.device) != devices_.end();
  }

  void count_what_is_there() {
    for (const record::Record& record : context_.store.records(context_.run)) {
      if (!is_ours(record)) continue;
      count(record, result_);
      ++result_.there_before;
    }
  }

  // What the store knows of this run's devices: with --resume, rounds of before too.
  void remember_records() {
    for (record::Record& record : context_.store.records(context_.run)) {
      if (!record.same_as.empty()) {
        if (is_on_our_devices(record)) twins_.push_back(std::move(record));
      } else if (is_ours(record)) {
        records_.push_back(std::move(record));
      }
    }
    for (const record::Record& record : records_) share_rounds(record);
  }

  // A configuration that fails now was measured by luck: its record says so.
  void once_more(record::Record& record, Report& report) {
    stop_if_asked();
    const auto [passes, ended, work_ns] =
        on(record.device)
            .round(*by_key_.at(record.configuration), record, [&](const Loading& loading) {
              report.loading(record.device, record.configuration, loading);
            });
    work_ns_ += work_ns;
    if (ended) {
      --result_.measured;
      record.outcome = ended->outcome;
      record.reason = fmt::format("in round {}: {}", record.rounds_ns.size() + 1, ended->reason);
      count(record, result_);
      context_.store.add_record(record);
    } else if (add_round(record, passes)) {
      ++result_.rounds_added;
      context_.store.update_times(record);
      share_rounds(record);
    }
    report.done(record);
  }

  const RunContext& context_;
  const std::vector<std::string>& devices_;
  const std::function<void(const Progress&)>& tell_;
  RunResult result_;
  double work_ns_ = 0;
  std::map<std::string, std::unique_ptr<DeviceRun>> open_;
  std::vector<record::Record> records_;  // of the plan, by frames of their own
  std::vector<record::Record> twins_;    // by those of another
  std::map<std::string, const Configuration*> by_key_;
  std::map<std::pair<std::string, std::string>, record::Record> measured_;  // device, configuration
};

}  // namespace

std::vector<RunResult> run_plans(std::span<const PlannedRun> runs,
                                 const std::vector<std::string>& devices, record::Store& store,
                                 const std::function<void(const Progress&)>& on_progress) {
  const Stopwatch run;
  for (const PlannedRun& each : runs) refuse_bad_options(each.options);
  InterruptGuard interrupts;
  std::deque<RunContext> contexts;  // each Measuring refers to its own
  std::deque<Measuring> all;
  for (const PlannedRun& each : runs) {
    const auto& [plan, suite, options] = each;
    contexts.push_back({plan, suite, store, options, interrupts, open_run(each, store),
                        kinds_of(plan, options.protocol)});
    all.emplace_back(contexts.back(), devices, on_progress).first_round();
  }
  std::size_t most = 1;
  for (const Measuring& each : all) most = std::max(most, each.most_rounds());
  for (std::size_t round = 2; round <= most; ++round) {
    for (Measuring& each : all) each.further_round(round, run);
  }
  std::vector<RunResult> results;
  results.reserve(all.size());
  for (Measuring& each : all) results.push_back(each.conclude());
  return results;
}

RunResult run_plan(const Plan& plan, const std::vector<std::string>& devices, const Suite& suite,
                   record::Store& store, const RunOptions& options,
                   const std::function<void(const Progress&)>& on_progress) {
  const PlannedRun alone{plan, suite, options};
  return std::move(run_plans({&alone, 1}, devices, store, on_progress).front());
}

}  // namespace triptych::measure
