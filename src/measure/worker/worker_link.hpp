#pragma once
// The supervisor's side of one worker: it sends a request, and gets an answer, the worker's death
// or a timeout.

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "measure/system/interrupt.hpp"
#include "measure/system/process.hpp"
#include "measure/worker/wire.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// Keeps the end of a worker's output, up to a fixed size.
class LogTail {
 public:
  void append(std::string_view text);
  void clear() noexcept { text_.clear(); }
  // The last lines without blank ones, separated by " | "; empty if there are none.
  [[nodiscard]] std::string last_lines(std::size_t count) const;

 private:
  static constexpr std::size_t most_bytes = 16384;
  std::string text_;
};

class WorkerLink {
 public:
  // The worker died: by a signal, with an exit code, or after an answer that makes no sense.
  struct Died {
    record::Reason reason;
  };
  // The worker gave no answer within the limit.
  struct Late {
    record::Reason reason;
  };
  using Reply = std::variant<Message, Died, Late>;

  // Throws IoError if the command cannot be started.
  WorkerLink(const std::vector<std::string>& command, const std::vector<std::string>& environment,
             InterruptGuard& interrupts);

  // After Died and Late, the process is gone and reaped, and the link cannot be used any longer.
  // Throws Interrupted if a signal asks the supervisor to stop. Progress of loading that the worker
  // reports before its answer is passed to `on_loading`, which may be empty.
  [[nodiscard]] Reply ask(const Message& request, std::chrono::milliseconds limit,
                          const OnLoading& on_loading = {});

  // Begins the conversation. Returns the worker's greeting, or the reason why its device cannot be
  // opened.
  [[nodiscard]] std::variant<Hello, Refused> greet(const Start& start,
                                                   std::chrono::milliseconds limit);

  // Lets an idle worker exit by itself, so that drivers can write their caches, and kills it if it
  // does not do so within a few seconds. Returns the fault of a driver that crashes or hangs during
  // this.
  std::optional<record::DeviceFault> finish();

 private:
  using Deadline = std::chrono::steady_clock::time_point;

  void read_answer();
  // The answer, if it has arrived. Messages before it are passed on.
  [[nodiscard]] std::optional<Message> next_answer(const OnLoading& on_loading);
  void read_log();
  // Waits until something happens at one of the descriptors; false if the deadline passes.
  [[nodiscard]] bool wait_for_event(Deadline deadline);
  [[nodiscard]] Died bury();
  // Kills the worker for `reason`.
  [[nodiscard]] record::Reason bury_for(record::Reason reason);
  // Waits until the worker is gone, and returns how it ended.
  [[nodiscard]] std::optional<Exit> reap();
  void await_own_end();
  // Asks a process that hangs for the call stack of its thread, which arrives as log.
  void ask_for_stack();
  [[nodiscard]] std::string last_words() const;

  Process process_;
  InterruptGuard& interrupts_;
  MessageBuffer answers_;
  LogTail log_;
  bool answers_open_ = true;
  bool log_open_ = true;
  bool ended_ = false;
};

}  // namespace triptych::measure
