#pragma once
// One device of a run, with the worker that serves it.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

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

// The result of one configuration on one device. `work_ns` is the part of its time that was spent
// on the device's work.
struct Done {
  record::Record record;
  std::vector<std::byte> exr = {};
  std::map<std::string, std::string> listings = {};  // disassemblies by content hash
  double work_ns = 0;
};

// Measures configurations on one device. A worker that has died is replaced for the next
// configuration. If two attempts in a row to start a worker fail, no further attempt is made.
class DeviceRun {
 public:
  DeviceRun(const RunContext& context, std::string device);

  using Ended = WorkerSlot::Ended;

  // All functions throw Interrupted, and InputError if the device has changed since the run began.

  // Measures the configuration by the complete protocol.
  [[nodiscard]] Done perform(const Configuration& configuration, const std::string& key,
                             const OnLoading& on_loading);

  // Returns a record with the outcome `why`, without drawing the configuration on the device.
  [[nodiscard]] Done pass_by(const Configuration& configuration, const std::string& key,
                             const Ended& why) const;

  // Lets the worker exit normally.
  void finish();

  // Returns the time for opening the device and calibrating its clocks. It counts as the device's
  // time, not as overhead.
  [[nodiscard]] double opening_ns() const { return slot_.opening_ns(); }

 private:
  [[nodiscard]] SideOptions side() const;
  void remember();
  [[nodiscard]] Protocol protocol() const;
  // See WorkerSlot::open.
  bool ensure_worker();
  void greet(const Hello& hello);
  [[nodiscard]] Job job(const Configuration& configuration, const std::string& key) const;
  void sign(const Job& job, const std::string& key, record::Record& record) const;
  // The time limit for one configuration.
  [[nodiscard]] std::chrono::seconds limit() const;
  [[nodiscard]] Done ask(const Job& job, const OnLoading& on_loading);
  // Reports a worker whose memory grows from configuration to configuration.
  void watch_memory(std::uint64_t peak_bytes);
  void only_counted(record::Record& record) const;
  // Returns the reason why this machine cannot count instructions, if the plan counts them; nullopt
  // otherwise.
  [[nodiscard]] std::optional<record::Reason> no_emulator() const;

  const RunContext& context_;
  std::string device_;
  CacheFolder cache_;
  WorkerSlot slot_;
  std::optional<record::Device> known_;
  std::vector<record::ClockTrust> clocks_;
  std::vector<std::uint64_t> peaks_;  // the worker's peak memory after each configuration
};

}  // namespace triptych::measure
