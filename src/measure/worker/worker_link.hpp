#pragma once
// The supervisor's connection to one worker. The result of a request is an answer, the worker's
// death or a timeout.

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

// Keeps the last part of a worker's output, up to a fixed size.
class LogTail {
 public:
  void append(std::string_view text);
  void clear() noexcept { text_.clear(); }
  // Returns the last `count` non-blank lines, separated by " | ".
  [[nodiscard]] std::string last_lines(std::size_t count) const;

 private:
  static constexpr std::size_t most_bytes = 16384;
  std::string text_;
};

class WorkerLink {
 public:
  // The worker was killed by a signal, exited, or was killed because its answer was invalid.
  struct Died {
    record::Reason reason;
  };
  // The worker did not answer within the time limit and was killed.
  struct TimedOut {
    record::Reason reason;
  };
  using Reply = std::variant<Message, Died, TimedOut>;

  // Starts the worker. Throws IoError if the command cannot be started.
  WorkerLink(const std::vector<std::string>& command, const std::vector<std::string>& environment,
             InterruptGuard& interrupts);

  // Sends a request and waits for the reply. If the reply is Died or TimedOut, the process has been
  // reaped, and the link must not be used any longer. If the worker reports loading progress before
  // its answer, the progress is passed to `on_loading`, unless `on_loading` is empty. Throws
  // Interrupted if a signal asks the supervisor to stop.
  [[nodiscard]] Reply send_request(const Message& request, std::chrono::milliseconds limit,
                                   const OnLoading& on_loading = {});

  // Sends the first message. Returns the worker's greeting, or the reason why its device cannot be
  // opened.
  [[nodiscard]] std::variant<Hello, Refused> greet(const Start& start,
                                                   std::chrono::milliseconds limit);

  // Lets an idle worker exit by itself, so that drivers can write their caches. Kills the worker if
  // it does not exit within a few seconds. Returns a device fault if the worker crashes or hangs
  // while it exits.
  std::optional<record::DeviceFault> finish();

 private:
  using Deadline = std::chrono::steady_clock::time_point;

  void read_answer();
  // Returns the answer if it has arrived. Passes loading progress that arrived before the answer to
  // `on_loading`.
  [[nodiscard]] std::optional<Message> next_answer(const OnLoading& on_loading);
  void read_log();
  // Waits for an event on any of the descriptors. Returns false if the deadline passes first.
  [[nodiscard]] bool wait_for_event(Deadline deadline);
  [[nodiscard]] Died reap_dead_worker();
  // Kills the worker, and returns `reason` with the worker's last output.
  [[nodiscard]] record::Reason kill_for(record::Reason reason);
  // Waits until the worker has ended, after killing it if necessary. Returns how it ended.
  [[nodiscard]] std::optional<Exit> reap();
  void wait_for_interrupt();
  // Makes a hanging worker write the call stack of its thread to the log.
  void request_stack_trace();
  [[nodiscard]] std::string last_output() const;

  Process process_;
  InterruptGuard& interrupts_;
  MessageBuffer answers_;
  LogTail log_;
  bool answers_open_ = true;
  bool log_open_ = true;
  bool ended_ = false;
};

}  // namespace triptych::measure
