#pragma once
// A slot for a device's worker. A worker that is gone is replaced when the next one is needed.

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
  std::vector<std::string> command;  // the device is appended to it
  std::vector<std::string> environment;
  std::chrono::milliseconds limit{};  // for opening the device and calibrating its clocks
};

class WorkerSlot {
 public:
  WorkerSlot(WorkerSetup setup, InterruptGuard& interrupts)
      : setup_(std::move(setup)), interrupts_(interrupts) {}

  // Returns true if there is a worker, or if one could be started. A new worker is sent `start`.
  // Its greeting is passed to `greeted`, which may refuse the worker by an exception. If a worker
  // cannot be started twice in a row, or if the device lacks something, no further attempt is made:
  // this and all later calls return false, and why_closed() has the reason.
  bool open(const std::function<Start()>& start, const std::function<void(const Hello&)>& greeted);
  [[nodiscard]] const record::Reason& why_closed() const noexcept { return why_closed_.reason; }
  // Whether the reason is something that the device lacks.
  [[nodiscard]] bool unsupported() const noexcept { return why_closed_.unsupported(); }

  // The worker. The slot must be open.
  [[nodiscard]] WorkerLink& worker() const { return *worker_; }
  [[nodiscard]] bool occupied() const noexcept { return worker_ != nullptr; }

  // The end of a worker that gave no answer.
  struct Ended {
    record::Outcome outcome;
    record::Reason reason;
  };
  // Sends a job to the worker. The slot must be open. It is vacated if the worker has ended, and in
  // the cases of vacate_after().
  [[nodiscard]] std::variant<Answer, Ended> ask(const Message& job, std::chrono::milliseconds limit,
                                                const OnLoading& on_loading);

  // Lets the worker exit normally. Returns the fault of a driver that appears while it does so.
  std::optional<record::DeviceFault> finish();
  void vacate() noexcept { worker_.reset(); }  // kills the worker if it still runs
  // Vacates the slot if the device is lost or a frame was not drawn: drivers ignore all further
  // commands after some errors without reporting any of them.
  void vacate_after(record::Outcome outcome, const record::Reason& reason) noexcept;

  // The time for opening the device, over all workers.
  [[nodiscard]] double opening_ns() const noexcept { return opening_ns_; }

 private:
  // The result has no reason if a worker has sent its greeting; otherwise it has the reason why
  // there is none.
  [[nodiscard]] Refused try_to_open(const Start& start,
                                    const std::function<void(const Hello&)>& greeted);

  WorkerSetup setup_;
  InterruptGuard& interrupts_;
  std::unique_ptr<WorkerLink> worker_;
  Refused why_closed_;
  std::optional<record::DeviceFault> statistics_fault_;  // the driver crashes when they are read
  double opening_ns_ = 0;
};

}  // namespace triptych::measure
