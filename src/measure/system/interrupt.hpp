#pragma once
// Turns SIGINT and SIGTERM into events for which a loop can wait together with its pipes, so that
// the process does not end in the middle of its work.

#include <atomic>
#include <csignal>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "measure/system/process.hpp"

namespace triptych::measure {

// Thrown if a signal asked the run to stop. Its workers have ended, and every record so far is in
// the store, so the run can be resumed. Callers that have a store and an option --resume print how
// to continue.
class Interrupted : public core::Error {
 public:
  explicit Interrupted(int signal, const std::string& what = "interrupted")
      : Error(what), signal_(signal) {}
  [[nodiscard]] int signal() const noexcept { return signal_; }

 private:
  int signal_;
};

// While this object exists, SIGINT, SIGTERM and SIGPIPE are blocked in the calling thread and
// arrive at fd(). Writing to a pipe without a reader then returns an error. The destructor restores
// the previous state, and raises an interrupt again if take() has not returned it.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  // The descriptor is readable if a signal has arrived.
  [[nodiscard]] int fd() const noexcept { return signals_.get(); }
  // Returns the interrupting signal if one has arrived. SIGPIPE is ignored. Once a signal has
  // arrived, all further calls on all threads return it.
  [[nodiscard]] std::optional<int> take();

 private:
  void read_signals();

  sigset_t before_{};
  FileDescriptor signals_;
  std::atomic<int> signal_{0};
  std::atomic<bool> told_{false};
};

}  // namespace triptych::measure
