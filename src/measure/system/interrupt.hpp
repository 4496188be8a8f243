#pragma once
// SIGINT and SIGTERM as something that a loop can wait for beside its pipes, instead of dying in
// the middle of them.

#include <atomic>
#include <csignal>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "measure/system/process.hpp"

namespace triptych::measure {

// A signal asked the run to stop: its workers are gone, every record made so far is in the store,
// and `resume` goes on from there. Whoever has a store and a --resume to offer says so.
class Interrupted : public core::Error {
 public:
  explicit Interrupted(int signal, const std::string& what = "interrupted")
      : Error(what), signal_(signal) {}
  [[nodiscard]] int signal() const noexcept { return signal_; }

 private:
  int signal_;
};

// While it lives, SIGINT, SIGTERM and SIGPIPE are blocked in the calling thread and arrive at fd();
// writing to a pipe nobody reads is then an error code. Destroying it restores what was; an
// interrupt that nobody asked for is raised again.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  [[nodiscard]] int fd() const noexcept { return signals_.get(); }  // readable when a signal waits
  // The interrupting signal, if one has come; SIGPIPE is dropped. Once there, it is there for
  // everybody who asks, on any thread.
  [[nodiscard]] std::optional<int> take();

 private:
  void read_signals();

  sigset_t before_{};
  FileDescriptor signals_;
  std::atomic<int> signal_{0};
  std::atomic<bool> told_{false};
};

}  // namespace triptych::measure
