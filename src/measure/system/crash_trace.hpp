#pragma once

namespace triptych::measure {

// The maximum number of frames in a call stack. The innermost frames are written, because they show
// where the driver is.
inline constexpr int most_traced_frames = 20;

// Installs signal handlers that write the call stack of the thread to stderr, one frame per line,
// with the name of the function if its library or program exports it (src/app/exported.list makes
// the linker export Triptych's functions). The handlers run if an error signal (SIGSEGV, SIGBUS,
// SIGILL, SIGFPE, SIGABRT) ends the process. The handler for SIGUSR2 also writes the call stack but
// does not end the process. The supervisor sends SIGUSR2 to find out where a process hangs. If a
// driver installs its own handlers, they replace these handlers.
void install_stack_trace_handlers();

}  // namespace triptych::measure
