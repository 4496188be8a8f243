#pragma once
// Keeps at most one worker process for a device. The slot is occupied while it has a worker. A
// worker that has ended is replaced when a worker is needed again.

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "measure/system/interrupt.hpp"
#include "measure/worker/worker_link.hpp"

namespace triptych::measure {

struct WorkerSetup {
  std::string device;
  std::vector<std::string> command;  // the device id is appended to it
  std::vector<std::string> environment;
  std::chrono::milliseconds limit{};  // time limit for opening the device and calibrating
};

class WorkerSlot {
 public:
  WorkerSlot(WorkerSetup setup, InterruptGuard& interrupts)
      : setup_(std::move(setup)), interrupts_(interrupts) {}

  // Starts a worker if there is none. Returns true if there is a worker now. A new worker receives
  // the message that `start` returns. Its greeting is passed to `on_hello`, which may throw an
  // exception to reject the worker. No further attempt is made if two attempts in a row fail, or if
  // the device does not support the request. However, if the second attempt ended with a crash or a
  // timeout, one more attempt is made, in which pipeline statistics are not read. After the last
  // attempt, this call and all later calls return false, and why_closed() returns the reason.
  bool open(const std::function<Start()>& start, const std::function<void(const Hello&)>& on_hello);
  [[nodiscard]] const record::Reason& why_closed() const noexcept { return why_closed_.reason; }
  // Returns whether the slot is closed because the device does not support the request.
  [[nodiscard]] bool unsupported() const noexcept { return why_closed_.unsupported(); }

  // Returns the worker. The slot must be occupied.
  [[nodiscard]] WorkerLink& worker() const { return *worker_; }
  [[nodiscard]] bool occupied() const noexcept { return worker_ != nullptr; }

  // How a worker ended without answering.
  struct Ended {
    record::Outcome outcome;
    record::Reason reason;
  };
  // Sends a job to the worker. The slot must be occupied. Vacates the slot if the worker has ended,
  // and in the cases of vacate_after().
  [[nodiscard]] std::variant<Answer, Ended> run_job(const Message& job,
                                                    std::chrono::milliseconds limit,
                                                    const OnLoading& on_loading);

  // Lets the worker exit normally. Returns a device fault if the worker crashes or hangs while it
  // exits.
  std::optional<record::DeviceFault> finish();
  void vacate() noexcept { worker_.reset(); }  // kills the worker if it still runs
  // Vacates the slot if the device is lost or a frame was not drawn. After such errors, drivers may
  // ignore all further commands without reporting an error.
  void vacate_after(record::Outcome outcome, const record::Reason& reason) noexcept;

  // Returns the total time that the workers of this slot have spent on opening the device and
  // calibrating.
  [[nodiscard]] double opening_ns() const noexcept { return opening_ns_; }

 private:
  // Starts a worker. The result contains no reason if the worker sent its greeting. Otherwise it
  // contains the reason why there is no worker.
  [[nodiscard]] Refused try_to_open(const Start& start,
                                    const std::function<void(const Hello&)>& on_hello);

  WorkerSetup setup_;
  InterruptGuard& interrupts_;
  std::unique_ptr<WorkerLink> worker_;
  Refused why_closed_;
  // Set if the driver crashes while pipeline statistics are read.
  std::optional<record::DeviceFault> statistics_fault_;
  double opening_ns_ = 0;
};

}  // namespace triptych::measure
