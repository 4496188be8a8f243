#include "measure/system/crash_trace.hpp"

#include <dlfcn.h>
#include <execinfo.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <cstdint>
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

void write_hexadecimal(std::uintptr_t number) {
  std::array<char, 2 * sizeof number> digits{};
  std::size_t first = digits.size();
  do {
    digits.at(--first) = "0123456789abcdef"[number % 16];
    number /= 16;
  } while (number != 0);
  write_to_stderr("0x");
  write_to_stderr({digits.data() + first, digits.size() - first});
}

// Writes "library(function+offset)", or "library(+offset)" if the library does not export the
// function. Both have the same value in every process, unlike the address.
void write_frame(const void* address) {
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  Dl_info info{};
  if (::dladdr(address, &info) == 0 || info.dli_fname == nullptr) {
    write_hexadecimal(at);
    return write_to_stderr("\n");
  }
  const std::string_view path = info.dli_fname;
  write_to_stderr(path.substr(path.rfind('/') + 1));
  write_to_stderr("(");
  if (info.dli_sname != nullptr) write_to_stderr(info.dli_sname);
  write_to_stderr("+");
  write_hexadecimal(at - reinterpret_cast<std::uintptr_t>(
                             info.dli_sname != nullptr ? info.dli_saddr : info.dli_fbase));
  write_to_stderr(")\n");
}

// Writes the innermost frames of the call stack. Allocates no memory. The first call of backtrace()
// loads a library, so install_stack_trace_handlers() calls it once before any signal arrives.
void write_stack() {
  constexpr int own_frames = 3;  // this function, the handler and the kernel's trampoline
  std::array<void*, own_frames + most_traced_frames> frames{};
  const int count = ::backtrace(frames.data(), static_cast<int>(frames.size()));
  if (count <= own_frames) return;
  write_to_stderr("stack of the thread, innermost frame first:\n");
  for (int i = own_frames; i < count; ++i) write_frame(frames.at(static_cast<std::size_t>(i)));
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
