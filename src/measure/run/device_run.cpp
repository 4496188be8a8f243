#include "measure/run/device_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <variant>

#include "measure/counting/emulator.hpp"
#include "measure/system/compile_only.hpp"
#include "measure/system/stopwatch.hpp"

namespace triptych::measure {
namespace {

record::Record ended_record(record::Outcome outcome, record::Reason reason) {
  record::Record record;
  record.outcome = outcome;
  record.reason = std::move(reason);
  return record;
}

bool has_statistics_fault(const record::Device& device) {
  using enum record::DeviceFaultKind;
  return std::ranges::any_of(device.faults, [](const record::DeviceFault& each) {
    return each.kind == statistics_all_zero || each.kind == statistics_crash ||
           each.kind == statistics_not_ready;
  });
}

bool has_failed_calibration(const Hello& hello) {
  const auto& statistics = hello.device.statistics_calibration;
  return std::ranges::any_of(hello.clocks, std::logical_not{}, &record::ClockTrust::offered) ||
         std::ranges::any_of(statistics, [](const auto& each) {
           return each.second.worth == record::Worth::unknown;
         });
}

}  // namespace

DeviceRun::DeviceRun(const RunContext& context, std::string device)
    : context_(context),
      device_(std::move(device)),
      cache_(cache_name(side(), context.plan.counted())),
      slot_(worker_setup(side(), context.plan.counted(), cache_, context.options.start_limit),
            context.interrupts) {
  restore_device();
  if (!context.plan.counted()) return;
  if (auto setup = ahead_setup(side(), cache_, context.options.start_limit)) {
    ahead_.emplace(std::move(*setup), context.plan.suite, context.interrupts);
  }
}

SideOptions DeviceRun::side() const {
  return {device_, context_.options.worker_command, context_.options.worker_environment};
}

ConfigurationResult DeviceRun::measure(const Configuration& configuration, const std::string& key,
                                       const OnLoading& on_loading) {
  const Job job = this->job(configuration, key);
  ConfigurationResult result;
  if (!context_.plan.compiled() && compile_only(device_)) {
    result = {ended_record(record::Outcome::skipped, {.cause = record::Cause::not_supported,
                                                      .detail = std::string(only_compiles)})};
  } else if (const auto reason = no_emulator()) {
    result = {ended_record(record::Outcome::skipped, *reason)};
  } else if (!ensure_worker()) {
    result = {ended_record(slot_.unsupported() ? record::Outcome::skipped : record::Outcome::failed,
                           slot_.why_closed())};
  } else if (job.protocol.counted && known_->cpu_features.empty()) {
    result = {ended_record(record::Outcome::skipped, {.cause = record::Cause::not_on_processor})};
  } else {
    if (ahead_ && job.faults.empty()) ahead_->compile(job);
    result = run_job(job, on_loading);
  }
  if (job.protocol.counted) adjust_counted_record(result.record);
  set_identity(job, key, result.record);
  return result;
}

// Changes a failure under the emulator (which counts instructions) to a skip, because the emulator
// may have caused the failure. Other plans draw the same configuration without the emulator.
void DeviceRun::adjust_counted_record(record::Record& record) const {
  if (record.outcome == record::Outcome::measured) {
    record.counted_by = std::get<Emulator>(find_emulator()).name;
  } else if (record.outcome != record::Outcome::skipped) {
    record.reason.stage = record::Stage::counting;
    record.outcome = record::Outcome::skipped;
  }
}

std::optional<record::Reason> DeviceRun::no_emulator() const {
  if (!context_.plan.counted()) return std::nullopt;
  if (const auto* lacking = std::get_if<std::string>(&find_emulator())) {
    return record::Reason{.cause = record::Cause::no_emulator, .detail = *lacking};
  }
  return std::nullopt;
}

ConfigurationResult DeviceRun::record_untried(const Configuration& configuration,
                                              const std::string& key, const Ended& why) const {
  ConfigurationResult result{ended_record(why.outcome, why.reason)};
  set_identity(job(configuration, key), key, result.record);
  return result;
}

void DeviceRun::finish() {
  if (ahead_) ahead_->finish();
  std::optional<record::DeviceFault> fault = slot_.finish();
  if (!fault || !known_) return;
  known_->faults.push_back(std::move(*fault));
  context_.store.add_device(context_.run, *known_, clocks_);
}

// Restores the device's entry from the store when a run is resumed, so that all records of the run
// use the same clock calibration.
void DeviceRun::restore_device() {
  for (auto& entry : context_.store.devices(context_.run)) {
    if (entry.device.id != device_) continue;
    known_ = std::move(entry.device);
    clocks_ = std::move(entry.clocks);
  }
}

Protocol DeviceRun::protocol() const {
  Protocol protocol = context_.options.protocol;
  protocol.statistics =
      protocol.statistics && context_.plan.checks.contains(record::Check::statistics);
  protocol.timed = protocol.timed && context_.plan.timed();
  protocol.counted = context_.plan.counted();
  protocol.compiled = context_.plan.compiled();
  if (protocol.counted) {
    protocol.keep_image = context_.plan.judges_images();
    protocol.counters = context_.plan.judges_counters();
  }
  // A plan without times draws every configuration. In this way, it also tests whether
  // configurations that should be equivalent have equal images.
  protocol.measure_every = protocol.measure_every || !context_.plan.timed();
  return protocol;
}

Job DeviceRun::job(const Configuration& configuration, const std::string& key) const {
  return {.name = device_ + "/" + key,
          .configuration = configuration,
          .protocol = protocol(),
          .faults = faults_for(context_.options.faults, key, device_)};
}

// Sets the run, the configuration, the scene and the device of a record.
void DeviceRun::set_identity(const Job& job, const std::string& key, record::Record& record) const {
  record.run = context_.run;
  record.suite = context_.plan.suite;
  record.plan = context_.plan.name;
  record.configuration = key;
  record.scene = scene_key(context_.suite, job.configuration);
  record.technique = job.configuration.at("technique");
  record.device = device_;
  record.injected = fmt::format("{}", fmt::join(job.faults, "+"));
  if (record.factors.empty()) record.factors = job.configuration;
}

// Draws configurations again if the worker's memory grows suspiciously, and records a device fault
// if the driver does not free its memory. If the worker ends while it draws them, nothing is
// decided.
void DeviceRun::check_memory_growth(const Job& job, const record::Record& record) {
  const bool known = std::ranges::any_of(known_->faults, [](const record::DeviceFault& each) {
    return each.kind == record::DeviceFaultKind::memory_grows;
  });
  // A configuration whose results are those of an equivalent one was not drawn.
  if (known || !record.same_as.empty()) return;
  if (!growth_.add(job, record.peak_memory_bytes)) return;
  const Stopwatch stopwatch;
  std::vector<std::uint64_t> resident;
  for (const Job& repeat : growth_.repeats()) {
    const auto reply = slot_.run_job(to_message(repeat), limit(), {});
    const auto* answer = std::get_if<Answer>(&reply);
    if (answer == nullptr) break;
    resident.push_back(answer->resident_bytes);
  }
  repeats_ns_ += stopwatch.ns();
  if (resident.size() <= MemoryGrowth::window) return;
  const auto leak = growth_.leak(resident);
  if (!leak) return;
  known_->faults.push_back(
      {.kind = record::DeviceFaultKind::memory_grows,
       .detail = fmt::format("when {} configurations were drawn a second time, the worker's memory "
                             "grew by another {} MiB per configuration and reached {} MiB",
                             MemoryGrowth::window, *leak >> 20U, resident.back() >> 20U)});
  context_.store.add_device(context_.run, *known_, clocks_);
}

// Opens the worker. If a calibration scene failed, the driver may be in a state in which it no
// longer draws anything. In this case, a second worker, which does not calibrate, draws the
// configurations.
bool DeviceRun::ensure_worker() {
  bool calibration_failed = false;
  const auto open = [&] {
    return slot_.open(
        [this] {
          return Start{.suite = context_.plan.suite,
                       .kinds = context_.kinds,
                       .clocks = clocks_,
                       .statistics = !known_ || !has_statistics_fault(*known_)};
        },
        [&](const Hello& hello) {
          calibration_failed =
              clocks_.size() < hello.clocks.size() && has_failed_calibration(hello);
          greet(hello);
        });
  };
  if (!open()) return false;
  if (!calibration_failed) return true;
  slot_.vacate();
  return open();
}

void DeviceRun::greet(const Hello& hello) {
  growth_.restart();
  if (known_ && known_->key() != hello.device.key()) {
    throw core::InputError(
        fmt::format("the device {} has changed since run {} began (then: {}; now: {}); start a new "
                    "run instead of using --resume",
                    device_, context_.run, known_->key(), hello.device.key()));
  }
  if (known_ && clocks_ == hello.clocks) return;
  known_ = hello.device;
  clocks_ = hello.clocks;
  context_.store.add_device(context_.run, *known_, clocks_);
}

std::chrono::seconds DeviceRun::limit() const {
  const std::chrono::seconds requested = context_.options.limit;
  if (context_.plan.counted()) return std::max(counted_limit, requested);
  // A plan that only compiles has a longer default limit. A limit that the user has set applies
  // even if it is shorter.
  return context_.plan.compiled() && requested == record::default_limit ? compiled_limit
                                                                        : requested;
}

ConfigurationResult DeviceRun::run_job(const Job& job, const OnLoading& on_loading) {
  const Stopwatch stopwatch;
  auto reply = slot_.run_job(to_message(job), limit(), on_loading);
  if (const auto* lost = std::get_if<Ended>(&reply))
    return {ended_record(lost->outcome, lost->reason)};
  Answer& answer = std::get<Answer>(reply);
  ConfigurationResult result{.record = std::move(answer.record),
                             .exr = std::move(answer.exr),
                             .listings = std::move(answer.listings),
                             .work_ns = answer.worker_ns - answer.record.overhead_ns};
  result.record.overhead_ns = stopwatch.ns() - result.work_ns;
  if (slot_.occupied()) check_memory_growth(job, result.record);
  return result;
}

}  // namespace triptych::measure
