#include "measure/runner.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <ctime>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <utility>

#include "measure/environment.hpp"
#include "measure/interrupt.hpp"
#include "measure/plant.hpp"
#include "measure/worker_link.hpp"
#include "technique/catalogue.hpp"

namespace triptych::measure {
namespace {

using Clock = std::chrono::steady_clock;

double ns_since(Clock::time_point start) {
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

std::string utc_now(const char* format) {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format(fmt::runtime(fmt::format("{{:{}}}", format)), fmt::gmtime(now));
}

record::Run new_run(const Plan& plan) {
  std::random_device entropy;
  return {.id = fmt::format("{}-{:08x}", utc_now("%Y%m%dT%H%M%SZ"), entropy()),
          .plan = plan.name,
          .started_at = utc_now("%Y-%m-%dT%H:%M:%SZ"),
          .system = system_facts()};
}

// The kinds of work whose clocks are needed.
std::vector<std::string> kinds_of(const Plan& plan) {
  std::set<std::string> kinds;
  if (!plan.timed) return {};
  for (const Configuration& configuration : plan.configurations) {
    kinds.emplace(technique::name_of(technique::technique(configuration.at("technique")).work));
  }
  return {kinds.begin(), kinds.end()};
}

// What every part of one run shares.
struct Context {
  const Plan& plan;
  const Suite& suite;
  record::Store& store;
  const RunOptions& options;
  InterruptGuard& interrupts;
  std::string run;
  std::vector<std::string> kinds;

  [[nodiscard]] std::vector<std::string> plants_for(const std::string& key,
                                                    const std::string& device) const {
    std::vector<std::string> plants;
    for (const Plant& plant : options.plants) {
      const auto matches = [&plant](const std::string& text) {
        return ::fnmatch(plant.only.c_str(), text.c_str(), 0) == 0;
      };
      if (plant.only.empty() || matches(key) || matches(device)) plants.push_back(plant.fault);
    }
    return plants;
  }
};

// One configuration on one device: what came of it, and the share of its time that was the
// device's.
struct Done {
  record::Record record;
  std::vector<std::byte> exr;
  double work_ns = 0;
};

// A device with the worker that serves it just now.
class DeviceRun {
 public:
  DeviceRun(const Context& context, std::string device)
      : context_(context),
        device_(std::move(device)),
        cache_(device_),
        environment_(worker_environment(device_, cache_)) {
    remember();
  }

  [[nodiscard]] Done perform(const Configuration& configuration, const std::string& key,
                             const OnLoading& on_loading) {
    Job job{.name = device_ + "/" + key,
            .configuration = configuration,
            .protocol = protocol(),
            .plants = context_.plants_for(key, device_)};
    Done done =
        ensure_worker() ? ask(job, on_loading) : Done{ended(record::Outcome::failed, no_worker_)};
    record::Record& record = done.record;
    record.run = context_.run;
    record.suite = context_.plan.suite;
    record.plan = context_.plan.name;
    record.configuration = key;
    record.scene = scene_key(context_.suite, configuration);
    record.technique = configuration.at("technique");
    record.device = device_;
    record.planted = fmt::format("{}", fmt::join(job.plants, "+"));
    if (record.factors.empty()) record.factors = configuration;
    return done;
  }

  // Lets the worker leave in peace.
  void finish() {
    if (worker_) worker_->finish();
    worker_.reset();
  }

  // Opening the driver and calibrating its clocks is the device's work, not ours.
  [[nodiscard]] double opening_ns() const { return opening_ns_; }

 private:
  static record::Record ended(record::Outcome outcome, std::string reason) {
    record::Record record;
    record.outcome = outcome;
    record.reason = std::move(reason);
    return record;
  }

  // A resumed run goes on with the clocks it began with: records of one run rest on one verdict.
  void remember() {
    for (auto& entry : context_.store.devices(context_.run)) {
      if (entry.device.id != device_) continue;
      known_ = std::move(entry.device);
      clocks_ = std::move(entry.clocks);
    }
  }

  [[nodiscard]] Protocol protocol() const {
    Protocol protocol = context_.options.protocol;
    protocol.timed = protocol.timed && context_.plan.timed;
    return protocol;
  }

  // False when no worker can be had, now or later; the reason is then in no_worker_.
  bool ensure_worker() {
    constexpr int most_attempts = 2;
    for (int attempt = 0; !worker_ && no_worker_.empty(); ++attempt) {
      std::string reason = start_worker();
      if (!reason.empty() && attempt + 1 >= most_attempts) no_worker_ = std::move(reason);
    }
    return worker_ != nullptr;
  }

  // Empty when a worker has said hello, else why not.
  std::string start_worker() {
    std::vector<std::string> command = context_.options.worker_command;
    command.push_back(device_);
    std::unique_ptr<WorkerLink> worker;
    try {
      worker = std::make_unique<WorkerLink>(command, environment_, context_.interrupts);
    } catch (const core::IoError& error) {
      return fmt::format("{} cannot be opened: {}", device_, error.what());
    }
    const Start start{.suite = context_.plan.suite, .kinds = context_.kinds, .clocks = clocks_};
    const auto asked = Clock::now();
    const auto greeting = worker->greet(start, context_.options.start_limit);
    opening_ns_ += ns_since(asked);
    if (const auto* reason = std::get_if<std::string>(&greeting)) {
      return fmt::format("{} cannot be opened: {}", device_, *reason);
    }
    greet(std::get<Hello>(greeting));
    worker_ = std::move(worker);
    return {};
  }

  void greet(const Hello& hello) {
    if (known_ && known_->key() != hello.device.key()) {
      throw core::InputError(
          fmt::format("{} has changed since run {} began (then {}; now {}): begin a new run "
                      "instead of resuming",
                      device_, context_.run, known_->key(), hello.device.key()));
    }
    if (known_ && clocks_ == hello.clocks) return;
    known_ = hello.device;
    clocks_ = hello.clocks;
    context_.store.add_device(context_.run, *known_, clocks_);
  }

  Done ask(const Job& job, const OnLoading& on_loading) {
    const auto start = Clock::now();
    WorkerLink::Reply reply = worker_->ask(to_message(job), context_.options.limit, on_loading);
    if (auto* died = std::get_if<WorkerLink::Died>(&reply)) {
      worker_.reset();
      return {ended(record::Outcome::crashed, std::move(died->reason))};
    }
    if (auto* late = std::get_if<WorkerLink::Late>(&reply)) {
      worker_.reset();
      return {ended(record::Outcome::hung, std::move(late->reason))};
    }
    std::optional<Answer> answer;
    try {
      answer = as_answer(std::move(std::get<Message>(reply)));
      if (!answer) throw core::InputError("the worker said something other than its answer");
    } catch (const core::InputError& error) {
      worker_.reset();
      return {ended(record::Outcome::failed, error.what())};
    }
    if (answer->record.outcome == record::Outcome::lost) worker_.reset();
    Done done{.record = std::move(answer->record),
              .exr = std::move(answer->exr),
              .work_ns = answer->worker_ns - answer->record.overhead_ns};
    done.record.overhead_ns = ns_since(start) - done.work_ns;
    return done;
  }

  const Context& context_;
  std::string device_;
  CacheFolder cache_;
  std::vector<std::string> environment_;
  std::optional<record::Device> known_;
  std::vector<record::ClockTrust> clocks_;
  double opening_ns_ = 0;
  std::unique_ptr<WorkerLink> worker_;
  std::string no_worker_;
};

void count(const record::Record& record, RunResult& result) {
  switch (record.outcome) {
    case record::Outcome::measured:
      ++result.measured;
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

// Tells how far the run is, with the time left as the mean of what was done foretells it.
class Report {
 public:
  Report(int total, const std::function<void(const Progress&)>& tell)
      : total_(total), tell_(tell), start_(Clock::now()) {}

  void already_done() { --total_; }

  void done(const record::Record& record) {
    ++done_;
    if (!tell_) return;
    const auto spent = Clock::now() - start_;
    const auto left = spent / done_ * (total_ - done_);
    tell_({.device = record.device,
           .configuration = record.configuration,
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
           .done = done_,
           .total = total_,
           .left = {},
           .record = nullptr,
           .loading = loading});
  }

 private:
  int total_;
  int done_ = 0;
  const std::function<void(const Progress&)>& tell_;
  Clock::time_point start_;
};

// The work of a device that a resumed run has not done yet.
std::vector<const Configuration*> pending(const Context& context, const std::string& device,
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

// The id of the run to add to: a new one, or the plan's latest when it is to be resumed.
std::string open_run(const Plan& plan, record::Store& store, bool resume) {
  if (resume) {
    if (const auto latest = store.latest_run(plan.name)) return latest->id;
  }
  const record::Run run = new_run(plan);
  store.add_run(run);
  return run.id;
}

void refuse_bad_options(const RunOptions& options) {
  if (const auto reason = forbids_measuring()) throw core::InputError(*reason);
  for (const Plant& plant : options.plants) check_plant(plant.fault);
}

}  // namespace

RunResult run_plan(const Plan& plan, const std::vector<std::string>& devices, const Suite& suite,
                   record::Store& store, const RunOptions& options,
                   const std::function<void(const Progress&)>& on_progress) {
  const auto start = Clock::now();
  refuse_bad_options(options);
  InterruptGuard interrupts;
  RunResult result;
  const Context context{plan,          suite,      store,
                        options,       interrupts, open_run(plan, store, options.resume),
                        kinds_of(plan)};
  result.run = context.run;
  Report report(static_cast<int>(plan.configurations.size() * devices.size()), on_progress);
  std::vector<std::pair<std::string, std::vector<const Configuration*>>> work;
  work.reserve(devices.size());
  for (const std::string& device : devices) {
    work.emplace_back(device, pending(context, device, report));
  }

  double work_ns = 0;
  for (const auto& [device, configurations] : work) {
    if (configurations.empty()) continue;
    DeviceRun device_run(context, device);
    for (const Configuration* configuration : configurations) {
      if (const auto signal = interrupts.take()) throw Interrupted(*signal);
      const std::string key = configuration_key(suite, *configuration);
      const Done done = device_run.perform(
          *configuration, key,
          [&, &on = device](const Loading& loading) { report.loading(on, key, loading); });
      // The image first: a record must never name one that is not there.
      if (!done.record.image.empty()) store.add_image(done.record.image, done.exr);
      store.add_record(done.record);
      work_ns += done.work_ns;
      count(done.record, result);
      report.done(done.record);
    }
    device_run.finish();
    work_ns += device_run.opening_ns();
  }
  result.wall_ns = ns_since(start);
  result.overhead_ns = result.wall_ns - work_ns;
  return result;
}

}  // namespace triptych::measure
