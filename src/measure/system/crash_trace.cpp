#include "measure/system/crash_trace.hpp"

#include <execinfo.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace triptych::measure {
namespace {

constexpr std::array error_signals{SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT};

// The size of the separate stack for the signal handlers. They need a separate stack because a
// stack overflow leaves no space on the thread's own stack.
constexpr std::size_t handler_stack_bytes = std::size_t{64} << 10U;

void write_to_stderr(std::string_view text) {
  // If write() fails, there is no way to report it, so its result is ignored.
  static_cast<void>(!::write(STDERR_FILENO, text.data(), text.size()));
}

// Writes the call stack. Calls only functions that are safe in a signal handler. The first call of
// backtrace() loads a library, so install_stack_trace_handlers() calls it once before any signal
// arrives.
void write_stack() {
  constexpr int most_frames = 24;
  constexpr int own_frames = 3;  // this function, the handler and the kernel's trampoline
  std::array<void*, most_frames> frames{};
  const int count = ::backtrace(frames.data(), most_frames);
  if (count <= own_frames) return;
  write_to_stderr("stack of the thread, innermost frame first:\n");
  ::backtrace_symbols_fd(frames.data() + own_frames, count - own_frames, STDERR_FILENO);
}

void on_error(int signal) {
  write_stack();
  // The default action was restored before this handler ran, so raising the signal again ends the
  // process.
  std::raise(signal);
}

void on_stack_request(int /*signal*/) {
  write_stack();
}

void set_handler(int signal, void (*handler)(int), int flags) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  ::sigemptyset(&action.sa_mask);
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

void install_stack_trace_handlers() {
  static std::array<std::byte, handler_stack_bytes> stack;
  const stack_t alternate{.ss_sp = stack.data(), .ss_flags = 0, .ss_size = stack.size()};
  ::sigaltstack(&alternate, nullptr);
  std::array<void*, 1> frame{};
  ::backtrace(frame.data(), 1);
  for (const int signal : error_signals) {
    set_handler(signal, &on_error, static_cast<int>(SA_RESETHAND | SA_ONSTACK | SA_NODEFER));
  }
  set_handler(SIGUSR2, &on_stack_request, SA_ONSTACK | SA_RESTART);
}

}  // namespace triptych::measure
