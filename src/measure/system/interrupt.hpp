#pragma once
// Converts SIGINT and SIGTERM to events on a file descriptor. A loop can wait for them together
// with its pipes, so the process does not end in the middle of its work.

#include <atomic>
#include <csignal>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "measure/system/process.hpp"

namespace triptych::measure {

// Thrown if a signal asked the program to stop a run. At this point, the run's workers have ended,
// and every record so far is in the store, so the run can be resumed. Callers that have a store and
// an option --resume print how to continue.
class Interrupted : public core::Error {
 public:
  explicit Interrupted(int signal, const std::string& what = "interrupted")
      : Error(what), signal_(signal) {}
  [[nodiscard]] int signal() const noexcept { return signal_; }

 private:
  int signal_;
};

// While this object exists, SIGINT, SIGTERM and SIGPIPE are blocked in the calling thread and
// arrive at fd(). With SIGPIPE blocked, writing to a pipe without a reader returns an error. The
// destructor restores the previous state. If a signal arrived that take() has not returned, the
// destructor raises it again.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  // Returns a descriptor that is readable if a signal has arrived.
  [[nodiscard]] int fd() const noexcept { return signals_.get(); }
  // Returns SIGINT or SIGTERM if it has arrived; ignores SIGPIPE. Once a signal has arrived, all
  // further calls on all threads return it.
  [[nodiscard]] std::optional<int> received_signal();

 private:
  void read_signals();

  sigset_t before_{};
  FileDescriptor signals_;
  std::atomic<int> signal_{0};
  std::atomic<bool> reported_{false};
};

}  // namespace triptych::measure
