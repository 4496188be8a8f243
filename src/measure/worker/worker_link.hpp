#pragma once
// The supervisor's end of one worker: ask, and get an answer, a death or a timeout.

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

// The end of what a worker printed, bounded however much it prints.
class LogTail {
 public:
  void append(std::string_view text);
  void clear() noexcept { text_.clear(); }
  // The last lines, blank ones left out, " | " between them; empty when there are none.
  [[nodiscard]] std::string last_lines(std::size_t count) const;

 private:
  static constexpr std::size_t most_bytes = 16384;
  std::string text_;
};

class WorkerLink {
 public:
  // How it ended: a signal, an exit code, an answer without sense.
  struct Died {
    record::Reason reason;
  };
  // That it gave no answer within the limit.
  struct Late {
    record::Reason reason;
  };
  using Reply = std::variant<Message, Died, Late>;

  // Throws IoError when the command cannot be started.
  WorkerLink(const std::vector<std::string>& command, const std::vector<std::string>& environment,
             InterruptGuard& interrupts);

  // After Died and Late the process is gone and reaped, and the link of no more use. Throws
  // Interrupted when a signal asks the supervisor to stop. What the worker says of loading before
  // it answers goes to `on_loading`, which may be empty.
  [[nodiscard]] Reply ask(const Message& request, std::chrono::milliseconds limit,
                          const OnLoading& on_loading = {});

  // Begins to talk: what the worker greets with, or why its device cannot be opened.
  [[nodiscard]] std::variant<Hello, Refused> greet(const Start& start,
                                                   std::chrono::milliseconds limit);

  // Lets an idle worker leave by itself, so that drivers can write their caches; kills it when it
  // does not within a few seconds. A driver that crashes or hangs meanwhile is returned as a fault.
  std::optional<record::DeviceFault> finish();

 private:
  using Deadline = std::chrono::steady_clock::time_point;

  void read_answer();
  // The answer, if it is there; what comes before it is handed on.
  [[nodiscard]] std::optional<Message> next_answer(const OnLoading& on_loading);
  void read_log();
  // Waits until something happened at one of the descriptors; false at the deadline.
  [[nodiscard]] bool wait_for_event(Deadline deadline);
  [[nodiscard]] Died bury();
  // Kills it first, for `reason`.
  [[nodiscard]] record::Reason bury_for(record::Reason reason);
  // Waits until it is gone; how it ended.
  [[nodiscard]] std::optional<Exit> reap();
  void await_own_end();
  // Of a process that hangs: asks it for the stack of its thread, which comes as log.
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
