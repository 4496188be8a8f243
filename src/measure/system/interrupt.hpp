#pragma once
// Makes SIGINT and SIGTERM events for which a loop can wait together with its pipes, so that the
// process does not die in the middle of work.

#include <atomic>
#include <csignal>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "measure/system/process.hpp"

namespace triptych::measure {

// A signal asked the run to stop. Its workers have ended, every record so far is in the store, and
// `resume` continues from there. Callers that have a store and a --resume print how to continue.
class Interrupted : public core::Error {
 public:
  explicit Interrupted(int signal, const std::string& what = "interrupted")
      : Error(what), signal_(signal) {}
  [[nodiscard]] int signal() const noexcept { return signal_; }

 private:
  int signal_;
};

// While this object lives, SIGINT, SIGTERM and SIGPIPE are blocked in the calling thread and arrive
// at fd(). Writing to a pipe without a reader is then an error code. The destructor restores the
// previous state; an interrupt that nobody has taken is raised again.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  [[nodiscard]] int fd() const noexcept {
    return signals_.get();
  }  // readable if a signal is waiting
  // The interrupting signal, if one has arrived; SIGPIPE is dropped. Once it has arrived, every
  // caller on any thread gets it.
  [[nodiscard]] std::optional<int> take();

 private:
  void read_signals();

  sigset_t before_{};
  FileDescriptor signals_;
  std::atomic<int> signal_{0};
  std::atomic<bool> told_{false};
};

}  // namespace triptych::measure
