#pragma once
// The place of a device's worker. One that is gone is replaced when the next is needed.

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "measure/system/interrupt.hpp"
#include "measure/worker/worker_link.hpp"

namespace triptych::measure {

struct WorkerSetup {
  std::string device;
  std::vector<std::string> command;  // to which the device is appended
  std::vector<std::string> environment;
  std::chrono::milliseconds limit{};  // of opening the device and calibrating its clocks
};

class WorkerSlot {
 public:
  WorkerSlot(WorkerSetup setup, InterruptGuard& interrupts)
      : setup_(std::move(setup)), interrupts_(interrupts) {}

  // True where a worker is there or could be started; it is told `start` and what it greets with is
  // handed on before it is kept, so that `greeted` may refuse it by an exception. One that cannot
  // be started twice in a row, or whose device lacks something, is not tried again: false then, now
  // and later, and why_closed() has the reason.
  bool open(const std::function<Start()>& start, const std::function<void(const Hello&)>& greeted);
  [[nodiscard]] const record::Reason& why_closed() const noexcept { return why_closed_.reason; }
  // Whether it is something that the device lacks.
  [[nodiscard]] bool unsupported() const noexcept { return why_closed_.unsupported(); }

  // The worker, of a slot that is open.
  [[nodiscard]] WorkerLink& worker() const { return *worker_; }
  [[nodiscard]] bool occupied() const noexcept { return worker_ != nullptr; }

  // Lets the worker leave in peace; a driver's fault while it does.
  std::optional<record::DeviceFault> finish();
  void vacate() noexcept { worker_.reset(); }  // it is gone, or goes now

  // Spent on devices' opening, over all workers.
  [[nodiscard]] double opening_ns() const noexcept { return opening_ns_; }

 private:
  // Without a reason when a worker has greeted, else why not.
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
