#pragma once
// One device of a run, with the worker that serves it.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "measure/run/runner.hpp"
#include "measure/system/environment.hpp"
#include "measure/system/interrupt.hpp"
#include "measure/worker/worker_setup.hpp"
#include "measure/worker/worker_slot.hpp"

namespace triptych::measure {

// What every part of one run shares.
struct RunContext {
  const Plan& plan;
  const Suite& suite;
  record::Store& store;
  const RunOptions& options;
  InterruptGuard& interrupts;
  std::string run;
  std::vector<std::string> kinds;  // of work whose clocks are needed
};

// One configuration on one device: what came of it, and the share of its time that was the
// device's.
struct Done {
  record::Record record;
  std::vector<std::byte> exr = {};
  std::map<std::string, std::string> listings = {};  // disassembly by its content hash
  double work_ns = 0;
};

// A worker that died is replaced by another for the next configuration; one that cannot be started
// twice in a row is not tried again.
class DeviceRun {
 public:
  DeviceRun(const RunContext& context, std::string device);

  // How an exchange ended that brought no answer.
  struct Ended {
    record::Outcome outcome;
    record::Reason reason;
  };

  // All throw Interrupted, and InputError when the device is no longer the one that the run began
  // with.

  // The whole protocol.
  [[nodiscard]] Done perform(const Configuration& configuration, const std::string& key,
                             const OnLoading& on_loading);

  // How it is said to have ended, without asking the device for it.
  [[nodiscard]] Done pass_by(const Configuration& configuration, const std::string& key,
                             const Ended& why) const;

  // Lets the worker leave in peace.
  void finish();

  // Opening the driver and calibrating its clocks is the device's work, not ours.
  [[nodiscard]] double opening_ns() const { return slot_.opening_ns(); }

 private:
  [[nodiscard]] SideOptions side() const;
  void remember();
  [[nodiscard]] Protocol protocol() const;
  // As WorkerSlot::open.
  bool ensure_worker();
  void greet(const Hello& hello);
  [[nodiscard]] Job job(const Configuration& configuration, const std::string& key) const;
  void sign(const Job& job, const std::string& key, record::Record& record) const;
  [[nodiscard]] Done ask(const Job& job, const OnLoading& on_loading);
  // Where there is no answer the worker is gone.
  [[nodiscard]] std::variant<Answer, Ended> exchange(const Message& message,
                                                     const OnLoading& on_loading);

  // Notes a worker whose memory grows from configuration to configuration.
  void watch_memory(std::uint64_t peak_bytes);
  void only_counted(record::Record& record) const;
  // Of a plan that counts, why nothing can be counted here; else nothing.
  [[nodiscard]] std::optional<record::Reason> no_emulator() const;

  const RunContext& context_;
  std::string device_;
  CacheFolder cache_;
  WorkerSlot slot_;
  std::optional<record::Device> known_;
  std::vector<record::ClockTrust> clocks_;
  std::vector<std::uint64_t> peaks_;  // of the worker's memory, configuration by configuration
};

}  // namespace triptych::measure
