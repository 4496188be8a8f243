#pragma once
// One device of a run, with the worker that serves it.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "measure/run/ahead_compiler.hpp"
#include "measure/run/memory_growth.hpp"
#include "measure/run/runner.hpp"
#include "measure/system/environment.hpp"
#include "measure/system/interrupt.hpp"
#include "measure/worker/worker_setup.hpp"
#include "measure/worker/worker_slot.hpp"

namespace triptych::measure {

// Data that all parts of one run share.
struct RunContext {
  const Plan& plan;
  const Suite& suite;
  record::Store& store;
  const RunOptions& options;
  InterruptGuard& interrupts;
  std::string run;
  std::vector<std::string> kinds;  // kinds of work whose clocks are needed
};

// The result of one configuration on one device. `work_ns` is the part of the elapsed time that was
// spent on the device's work.
struct ConfigurationResult {
  record::Record record;
  std::vector<std::byte> exr = {};
  std::map<std::string, std::string> listings = {};  // disassemblies by content hash
  double work_ns = 0;
};

// Measures configurations on one device. If a worker has died, a new worker measures the next
// configuration. If two attempts in a row to start a worker fail, no further attempt is made.
class DeviceRun {
 public:
  DeviceRun(const RunContext& context, std::string device);

  using Ended = WorkerSlot::Ended;

  // The functions below throw Interrupted if a signal asks the program to stop, and InputError if
  // the device has changed since the run began.

  // Measures the configuration by the complete protocol.
  [[nodiscard]] ConfigurationResult measure(const Configuration& configuration,
                                            const std::string& key, const OnLoading& on_loading);

  // Returns a record with the outcome and the reason in `why`, without drawing the configuration.
  [[nodiscard]] ConfigurationResult record_untried(const Configuration& configuration,
                                                   const std::string& key, const Ended& why) const;

  // Lets the worker exit, and stores a device fault if the worker crashes or hangs while it closes
  // the device.
  void finish();

  // Returns the time spent on opening the device, calibrating its clocks, compiling ahead, and
  // drawing configurations again after suspicious memory growth. It counts as time of the device,
  // not as overhead.
  [[nodiscard]] double opening_ns() const {
    return slot_.opening_ns() + (ahead_ ? ahead_->spent_ns() : 0) + repeats_ns_;
  }

 private:
  [[nodiscard]] SideOptions side() const;
  void restore_device();
  [[nodiscard]] Protocol protocol() const;
  // See WorkerSlot::open.
  bool ensure_worker();
  void greet(const Hello& hello);
  [[nodiscard]] Job job(const Configuration& configuration, const std::string& key) const;
  void set_identity(const Job& job, const std::string& key, record::Record& record) const;
  // Returns the time limit for one configuration.
  [[nodiscard]] std::chrono::seconds limit() const;
  [[nodiscard]] ConfigurationResult run_job(const Job& job, const OnLoading& on_loading);
  // Records a device fault if the driver does not free its memory. `record` is the result of the
  // job that was just drawn.
  void check_memory_growth(const Job& job, const record::Record& record);
  void adjust_counted_record(record::Record& record) const;
  // If the plan counts instructions but this machine cannot count them, returns the reason.
  // Otherwise returns nullopt.
  [[nodiscard]] std::optional<record::Reason> no_emulator() const;

  const RunContext& context_;
  std::string device_;
  CacheFolder cache_;
  WorkerSlot slot_;
  std::optional<AheadCompiler> ahead_;  // set if the plan counts and the driver can compile ahead
  std::optional<record::Device> known_;
  std::vector<record::ClockTrust> clocks_;
  MemoryGrowth growth_;
  double repeats_ns_ = 0;  // time spent on drawing configurations again
};

}  // namespace triptych::measure
