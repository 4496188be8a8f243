#include "measure/run/plan_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace triptych::measure {

// Reports the progress of the plan. The remaining time is estimated from the mean time of the
// finished configurations.
class Report {
 public:
  Report(std::size_t total, const PlanRun::OnProgress& on_progress)
      : total_(static_cast<int>(total)), on_progress_(on_progress) {}

  void already_done() { --total_; }

  void done(const record::Record& record) {
    ++done_;
    if (!on_progress_) return;
    const auto spent = since_.elapsed();
    const auto left = spent / done_ * (total_ - done_);
    on_progress_({.device = record.device,
                  .configuration = record.configuration,
                  .done = done_,
                  .total = total_,
                  .left = std::chrono::round<std::chrono::seconds>(left),
                  .record = &record,
                  .loading = {}});
  }

  void loading(const std::string& device, const std::string& key, const Loading& loading) {
    if (!on_progress_) return;
    on_progress_({.device = device,
                  .configuration = key,
                  .done = done_,
                  .total = total_,
                  .left = {},
                  .record = nullptr,
                  .loading = loading});
  }

 private:
  int total_;
  int done_ = 0;
  const PlanRun::OnProgress& on_progress_;
  Stopwatch since_;
};

namespace {

void count(const record::Record& record, RunResult& result) {
  switch (record.outcome) {
    case record::Outcome::measured:
      ++result.measured;
      if (!record.same_as.empty()) ++result.copied;
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

// Copies the results of a measured configuration to the record of an equivalent configuration,
// except for the benchmark entries.
void copy_results(record::Record& record, const record::Record& measured) {
  record.wall_ns = measured.wall_ns;
  record.device_ns = measured.device_ns;
  record.device_clock_trusted = measured.device_clock_trusted;
  record.warm_up_frames = measured.warm_up_frames;
  record.frames_per_100ms = measured.frames_per_100ms;
  record.loop_wall_ns = measured.loop_wall_ns;
  record.loop_frames = measured.loop_frames;
  record.memory = measured.memory;
  record.energy = measured.energy;
  record.counters = measured.counters;
  record.statistics = measured.statistics;
  record.image = measured.image;
  record.data_hash = measured.data_hash;
  record.kernel_hash = measured.kernel_hash;
  record.precision = measured.precision;
}

}  // namespace

PlanRun::PlanRun(const RunContext& context, const std::vector<std::string>& devices,
                 const OnProgress& on_progress)
    : context_(context), devices_(devices), on_progress_(on_progress) {
  result_.run = context.run;
  for (const Configuration& configuration : context.plan.configurations) {
    by_key_[configuration_key(context.suite, configuration)] = &configuration;
  }
  if (context.options.resume) count_stored_records();
}

RunResult PlanRun::measure_all() {
  const Stopwatch stopwatch;
  Report report(context_.plan.configurations.size() * devices_.size(), on_progress_);
  std::vector<std::pair<std::string, std::vector<const Configuration*>>> work;
  work.reserve(devices_.size());
  for (const std::string& device : devices_) {
    work.emplace_back(device, pending(device, report));
  }
  for (const auto& [device, configurations] : work) {
    for (const Configuration* configuration : configurations) {
      measure(device, *configuration, report);
    }
    close(device);
  }
  result_.wall_ns = stopwatch.ns();
  result_.devices_ns = result_.wall_ns;
  result_.overhead_ns = result_.wall_ns - work_ns_;
  return std::move(result_);
}

DeviceRun& PlanRun::device_run(const std::string& device) {
  auto& entry = open_[device];
  if (!entry) entry = std::make_unique<DeviceRun>(context_, device);
  return *entry;
}

FailurePredictor& PlanRun::failures_of(const std::string& device) {
  return failures_.try_emplace(device, context_.plan.varied).first->second;
}

void PlanRun::close(const std::string& device) {
  const auto entry = open_.find(device);
  if (entry == open_.end()) return;
  entry->second->finish();
  work_ns_ += entry->second->opening_ns();
  open_.erase(entry);
}

void PlanRun::throw_if_interrupted() {
  if (const auto signal = context_.interrupts.received_signal()) throw Interrupted(*signal);
}

// Returns the configurations that still have to be measured on a device.
std::vector<const Configuration*> PlanRun::pending(const std::string& device,
                                                   Report& report) const {
  std::vector<const Configuration*> result;
  for (const Configuration& configuration : context_.plan.configurations) {
    const std::string key = configuration_key(context_.suite, configuration);
    const bool done = context_.options.resume &&
                      !context_.options.remeasure.contains({device, key}) &&
                      context_.store.has_record(context_.run, key, device);
    if (done) {
      report.already_done();
    } else {
      result.push_back(&configuration);
    }
  }
  return result;
}

void PlanRun::measure(const std::string& device, const Configuration& configuration,
                      Report& report) {
  throw_if_interrupted();
  const std::string key = configuration_key(context_.suite, configuration);
  ConfigurationResult done = attempt(device, configuration, key, report);
  if (done.record.outcome == record::Outcome::measured) reuse_results(done.record);
  // Adds the image first, because a record must never refer to an image that does not exist.
  if (!done.exr.empty()) context_.store.add_image(done.record.image, done.exr);
  for (const auto& [hash, text] : done.listings) context_.store.add_listing(hash, text);
  context_.store.add_record(done.record);
  work_ns_ += done.work_ns;
  count(done.record, result_);
  failures_of(device).add(configuration, done.record);
  report.done(done.record);
}

// Measures a configuration. Does not try it if it is predicted to fail (FailurePredictor), or if
// two earlier attempts began but never ended. Without this limit, a driver that crashes the machine
// would crash it again with each --resume.
ConfigurationResult PlanRun::attempt(const std::string& device, const Configuration& configuration,
                                     const std::string& key, Report& report) {
  if (const auto prediction = failures_of(device).predict(configuration)) {
    return device_run(device).record_untried(configuration, key,
                                             {prediction->outcome, prediction->reason});
  }
  constexpr int most_attempts = 2;
  if (context_.store.begin_record(context_.run, key, device) > most_attempts) {
    return device_run(device).record_untried(
        configuration, key,
        {record::Outcome::crashed,
         {.cause = record::Cause::under_way, .numbers = {{"times", most_attempts}}}});
  }
  try {
    return device_run(device).measure(
        configuration, key, [&](const Loading& loading) { report.loading(device, key, loading); });
  } catch (...) {  // for example an interrupt, which does not count as a failed attempt
    context_.store.unbegin_record(context_.run, key, device);
    throw;
  }
}

// If the record belongs to a configuration that is equivalent to a measured one, copies the results
// of that configuration. Otherwise keeps a copy of the record, because later configurations may be
// equivalent to this one.
void PlanRun::reuse_results(record::Record& record) {
  if (record.same_as.empty()) {
    record::Record& copy = measured_[{record.device, record.configuration}];
    copy = record;
    copy.benchmark_json
        .clear();  // the largest part of a record, which copy_results() does not copy
  } else {
    copy_results(record, measured_.at({record.device, record.same_as}));
  }
}

// Returns whether the plan contains the record's configuration, the run contains its device, and
// the record is not to be measured again. If a run is resumed with a smaller plan, it contains
// records of configurations that the plan does not contain.
bool PlanRun::belongs_to_plan(const record::Record& record) const {
  return std::ranges::find(devices_, record.device) != devices_.end() &&
         !context_.options.remeasure.contains({record.device, record.configuration}) &&
         by_key_.contains(record.configuration);
}

void PlanRun::count_stored_records() {
  for (const record::Record& record : context_.store.records(context_.run)) {
    if (!belongs_to_plan(record)) continue;
    count(record, result_);
    ++result_.already_stored;
    failures_of(record.device).add(*by_key_.at(record.configuration), record);
  }
}

}  // namespace triptych::measure
