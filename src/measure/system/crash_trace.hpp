#pragma once

namespace triptych::measure {

// Installs signal handlers that write the call stack of the thread to stderr, one frame on each
// line, with the names of exported functions if they are known. They do so if a signal ends the
// process because of an error (SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT). SIGUSR2 also writes the
// call stack but does not end the process; a supervisor sends it to find out where a process hangs.
// A driver that sets its own handlers replaces these handlers.
void write_stack_of_crashes();

}  // namespace triptych::measure
