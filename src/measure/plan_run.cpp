#include "measure/plan_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "measure/rounds.hpp"

namespace triptych::measure {

// Tells how far a round is, with the time left as the mean of what was done foretells it.
class RoundReport {
 public:
  RoundReport(int round, std::size_t total, const PlanRun::Tell& tell)
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
  const PlanRun::Tell& tell_;
  Stopwatch since_;
};

namespace {

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
  record.memory = measured.memory;
  record.counters = measured.counters;
  record.statistics = measured.statistics;
  record.image = measured.image;
  record.data_hash = measured.data_hash;
  record.kernel_hash = measured.kernel_hash;
  record.precision = measured.precision;
}

}  // namespace

PlanRun::PlanRun(const RunContext& context, const std::vector<std::string>& devices,
                 const Tell& tell)
    : context_(context), devices_(devices), tell_(tell) {
  result_.run = context.run;
  for (const Configuration& configuration : context.plan.configurations) {
    by_key_[configuration_key(context.suite, configuration)] = &configuration;
  }
  if (context.options.resume) count_what_is_there();
}

void PlanRun::first_round() {
  const Stopwatch stopwatch;
  RoundReport report(1, context_.plan.configurations.size() * devices_.size(), tell_);
  std::vector<std::pair<std::string, std::vector<const Configuration*>>> work;
  work.reserve(devices_.size());
  for (const std::string& device : devices_) {
    work.emplace_back(device, pending(device, report));
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

void PlanRun::further_round(std::size_t round, const Stopwatch& run) {
  if (round > most_rounds()) return;
  const Stopwatch stopwatch;
  const auto& budget = context_.options.budget;
  const auto order = budget ? RoundOrder::doubtful_first : RoundOrder::as_measured;
  const std::vector<std::size_t> chosen = next_round(records_, most_rounds(), order);
  RoundReport report(static_cast<int>(round), chosen.size(), tell_);
  for (const std::size_t each : chosen) {
    if (budget && run.elapsed() >= *budget) break;
    once_more(records_[each], report);
  }
  result_.wall_ns += stopwatch.ns();
}

std::size_t PlanRun::most_rounds() const {
  constexpr std::size_t most_within_budget = 32;
  if (!context_.plan.timed() || !context_.options.protocol.timed) return 1;
  if (context_.options.rounds) return static_cast<std::size_t>(*context_.options.rounds);
  return context_.options.budget ? most_within_budget
                                 : static_cast<std::size_t>(context_.plan.rounds);
}

RunResult PlanRun::conclude() {
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

DeviceRun& PlanRun::on(const std::string& device) {
  auto& entry = open_[device];
  if (!entry) entry = std::make_unique<DeviceRun>(context_, device);
  return *entry;
}

void PlanRun::leave(const std::string& device) {
  const auto entry = open_.find(device);
  if (entry == open_.end()) return;
  entry->second->finish();
  work_ns_ += entry->second->opening_ns();
  open_.erase(entry);
}

void PlanRun::stop_if_asked() {
  if (const auto signal = context_.interrupts.take()) throw Interrupted(*signal);
}

// The work of a device that a resumed run has not done yet.
std::vector<const Configuration*> PlanRun::pending(const std::string& device,
                                                   RoundReport& report) const {
  std::vector<const Configuration*> result;
  for (const Configuration& configuration : context_.plan.configurations) {
    const bool done = context_.options.resume &&
                      context_.store.has_record(
                          context_.run, configuration_key(context_.suite, configuration), device);
    if (done) {
      report.already_done();
    } else {
      result.push_back(&configuration);
    }
  }
  return result;
}

void PlanRun::measure(const std::string& device, const Configuration& configuration,
                      RoundReport& report) {
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
Done PlanRun::attempt(const std::string& device, const Configuration& configuration,
                      const std::string& key, RoundReport& report) {
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
    return on(device).perform(
        configuration, key, [&](const Loading& loading) { report.loading(device, key, loading); });
  } catch (...) {  // an end that is known, and no fault of the configuration
    context_.store.unbegin_record(context_.run, key, device);
    throw;
  }
}

// A record of other frames tells what they told; one of its own may have to tell others.
void PlanRun::share_frames(record::Record& record) {
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
void PlanRun::share_rounds(const record::Record& measured) {
  for (record::Record& twin : twins_) {
    const bool of_it = twin.device == measured.device && twin.same_as == measured.configuration;
    if (!of_it || twin.rounds_ns == measured.rounds_ns) continue;
    take_over(twin, measured);
    context_.store.update_times(twin);
  }
}

// Of the plan, on the run's devices: what it is resumed with may be less than it began with.
bool PlanRun::is_ours(const record::Record& record) const {
  return is_on_our_devices(record) && by_key_.contains(record.configuration);
}

bool PlanRun::is_on_our_devices(const record::Record& record) const {
  return std::ranges::find(devices_, record.device) != devices_.end();
}

void PlanRun::count_what_is_there() {
  for (const record::Record& record : context_.store.records(context_.run)) {
    if (!is_ours(record)) continue;
    count(record, result_);
    ++result_.there_before;
  }
}

// What the store knows of this run's devices: with --resume, rounds of before too.
void PlanRun::remember_records() {
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
void PlanRun::once_more(record::Record& record, RoundReport& report) {
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

}  // namespace triptych::measure
