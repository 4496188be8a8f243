#include "measure/worker/worker_link.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <span>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "measure/system/crash_trace.hpp"

namespace triptych::measure {
namespace {

// Reads all available bytes from a non-blocking descriptor. Returns false if the other process has
// closed the pipe.
template <typename Take>
bool drain(int fd, Take take) {
  std::array<char, 65536> piece;
  for (;;) {
    const ssize_t got = ::read(fd, piece.data(), piece.size());
    if (got > 0) {
      take(std::span<const char>(piece.data(), static_cast<std::size_t>(got)));
    } else if (got == 0) {
      return false;
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      return true;
    } else if (errno != EINTR) {
      // This is not the end of the worker, so it must not be recorded as the driver's crash.
      throw core::IoError(fmt::format("cannot read from a worker process: {}",
                                      std::generic_category().message(errno)));
    }
  }
}

// Returns whether another process ended the worker on purpose. Drivers do not raise these signals.
bool was_ended_externally(const Exit& exit) {
  return exit.signal == SIGKILL || exit.signal == SIGTERM || exit.signal == SIGINT;
}

}  // namespace

void LogTail::append(std::string_view text) {
  text_ += text;
  if (text_.size() > most_bytes) text_.erase(0, text_.size() - most_bytes);
}

std::string LogTail::last_lines(std::size_t count) const {
  std::vector<std::string_view> lines;
  std::string_view rest = text_;
  while (!rest.empty() && lines.size() < count) {
    const auto split = rest.find_last_of("\r\n");
    const auto line = split == std::string_view::npos ? rest : rest.substr(split + 1);
    if (line.find_first_not_of(" \t") != std::string_view::npos) lines.push_back(line);
    rest = split == std::string_view::npos ? std::string_view() : rest.substr(0, split);
  }
  std::string result;
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    if (!result.empty()) result += " | ";
    result += *line;
  }
  return result;
}

WorkerLink::WorkerLink(const std::vector<std::string>& command,
                       const std::vector<std::string>& environment, InterruptGuard& interrupts)
    : process_(command, environment), interrupts_(interrupts) {}

WorkerLink::Reply WorkerLink::send_request(const Message& request, std::chrono::milliseconds limit,
                                           const OnLoading& on_loading) {
  log_.clear();
  const Deadline deadline = std::chrono::steady_clock::now() + limit;
  try {
    send(process_.request_fd(), request);
  } catch (const PipeClosed&) {
    return reap_dead_worker();
  }
  for (;;) {
    const bool in_time = wait_for_event(deadline);
    if (const auto signal = interrupts_.received_signal()) throw Interrupted(*signal);
    // Reads `ended_` before the pipe. If the worker has ended by then, the pipe already contains
    // everything that the worker wrote.
    const bool has_ended = ended_;
    read_answer();
    read_log();
    try {
      if (auto message = next_answer(on_loading)) return std::move(*message);
    } catch (const core::InputError& error) {
      return Died{kill_for({.cause = record::Cause::bad_answer, .detail = error.what()})};
    }
    if (has_ended || !answers_open_) return reap_dead_worker();
    if (!in_time) {
      const double limit_s = std::chrono::duration<double>(limit).count();
      return TimedOut{
          kill_for({.cause = record::Cause::timeout, .numbers = {{"limit_s", limit_s}}})};
    }
  }
}

std::variant<Hello, Refused> WorkerLink::greet(const Start& start,
                                               std::chrono::milliseconds limit) {
  const Reply reply = send_request(to_message(start), limit);
  if (const auto* died = std::get_if<Died>(&reply)) return Refused{died->reason};
  if (const auto* timed_out = std::get_if<TimedOut>(&reply)) return Refused{timed_out->reason};
  const Message& message = std::get<Message>(reply);
  if (const auto refused = as_refused(message)) return *refused;
  const auto hello = as_hello(message);
  if (!hello) return Refused{{.cause = record::Cause::no_greeting}};
  return *hello;
}

std::optional<record::DeviceFault> WorkerLink::finish() {
  constexpr std::chrono::seconds time_limit{5};
  constexpr std::chrono::milliseconds step{20};
  log_.clear();
  process_.close_requests();
  const Deadline deadline = std::chrono::steady_clock::now() + time_limit;
  std::optional<Exit> exit;
  do {
    exit = process_.wait(step);
    read_log();  // empties the pipe, because a process that is blocked by a full pipe cannot exit
  } while (!exit && std::chrono::steady_clock::now() < deadline);
  if (!exit) {
    request_stack_trace();
    process_.kill();
    static_cast<void>(process_.wait(time_limit));
    return record::DeviceFault{
        .kind = record::DeviceFaultKind::teardown_hang,
        .detail = fmt::format("the process did not exit within {} s", time_limit.count()),
        .last_output = last_output()};
  }
  if (was_ended_externally(*exit) || (exit->signal == 0 && exit->code == 0)) return std::nullopt;
  return record::DeviceFault{.kind = record::DeviceFaultKind::teardown_crash,
                             .detail = describe(*exit),
                             .last_output = last_output()};
}

void WorkerLink::request_stack_trace() {
  constexpr std::chrono::milliseconds time_limit{300};
  if (::kill(process_.pid(), SIGUSR2) != 0) return;
  const Deadline deadline = std::chrono::steady_clock::now() + time_limit;
  while (std::chrono::steady_clock::now() < deadline && log_open_) {
    pollfd event{process_.log_fd(), POLLIN, 0};
    if (::poll(&event, 1, static_cast<int>(time_limit.count())) <= 0) return;
    read_log();
  }
}

void WorkerLink::read_answer() {
  if (!answers_open_) return;
  answers_open_ = drain(process_.answer_fd(), [this](std::span<const char> piece) {
    answers_.append(std::as_bytes(piece));
  });
}

std::optional<Message> WorkerLink::next_answer(const OnLoading& on_loading) {
  while (auto message = answers_.next()) {
    const auto loading = as_loading(*message);
    if (!loading) return message;
    if (on_loading) on_loading(*loading);
  }
  return std::nullopt;
}

void WorkerLink::read_log() {
  if (!log_open_) return;
  log_open_ = drain(process_.log_fd(), [this](std::span<const char> piece) {
    log_.append({piece.data(), piece.size()});
  });
}

bool WorkerLink::wait_for_event(Deadline deadline) {
  std::array<pollfd, 4> events{{{answers_open_ ? process_.answer_fd() : -1, POLLIN, 0},
                                {log_open_ ? process_.log_fd() : -1, POLLIN, 0},
                                {process_.pid_fd(), POLLIN, 0},
                                {interrupts_.fd(), POLLIN, 0}}};
  const auto left =
      std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
  const auto timeout = std::clamp<std::chrono::milliseconds::rep>(left.count(), 0, 1'000'000'000);
  const int ready = ::poll(events.data(), events.size(), static_cast<int>(timeout));
  if (ready < 0 && errno != EINTR) throw core::IoError("cannot wait for a worker's answer");
  ended_ = events[2].revents != 0;
  return ready != 0;
}

std::optional<Exit> WorkerLink::reap() {
  // Waits before killing the worker. A worker that closed its answer pipe is about to exit, and its
  // exit status is needed.
  constexpr std::chrono::seconds time_limit{2};
  auto exit = process_.wait(time_limit);
  if (!exit) {
    process_.kill();
    exit = process_.wait(time_limit);
  }
  read_log();
  return exit;
}

WorkerLink::Died WorkerLink::reap_dead_worker() {
  const std::optional<Exit> exit = reap();
  if (exit && was_ended_externally(*exit)) wait_for_interrupt();
  record::Reason reason{.cause = record::Cause::unknown_end};
  if (exit && exit->signal != 0) {
    reason.cause = record::Cause::signal;
    reason.numbers["signal"] = exit->signal;
  } else if (exit) {
    reason.cause = record::Cause::exit_code;
    reason.numbers["exit_code"] = exit->code;
  }
  reason.last_output = last_output();
  return {std::move(reason)};
}

record::Reason WorkerLink::kill_for(record::Reason reason) {
  if (reason.cause == record::Cause::timeout) request_stack_trace();
  process_.kill();
  static_cast<void>(reap());
  reason.last_output = last_output();
  return reason;
}

// Waits up to 0.3 s for a signal that asks this process to stop, and throws Interrupted if it
// arrives. When a batch system ends a job, it ends the worker and this process at the same time. If
// the worker ends first, its end must not be recorded as a failure of the configuration.
void WorkerLink::wait_for_interrupt() {
  const Deadline deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(300);
  for (;;) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    pollfd event{interrupts_.fd(), POLLIN, 0};
    ::poll(&event, 1, static_cast<int>(std::max<std::int64_t>(0, left.count())));
    if (const auto signal = interrupts_.received_signal()) throw Interrupted(*signal);
    // Continues until the deadline, because another thread may have read the signal but not yet
    // stored it.
    if (std::chrono::steady_clock::now() >= deadline) return;
  }
}

std::string WorkerLink::last_output() const {
  // Enough for a call stack, its heading, and three messages before it.
  constexpr std::size_t lines = most_traced_frames + 4;
  return log_.last_lines(lines);
}

}  // namespace triptych::measure
