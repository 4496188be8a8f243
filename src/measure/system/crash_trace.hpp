#pragma once

namespace triptych::measure {

// From now on a signal that ends the process because of an error (SIGSEGV, SIGBUS, SIGILL, SIGFPE,
// SIGABRT) first writes the frames of the thread's stack to stderr, one a line, with the names of
// exported functions where they are known. SIGUSR2 does so without ending the process: a supervisor
// asks by it where a process hangs. A driver that sets handlers of its own replaces these.
void write_stack_of_crashes();

}  // namespace triptych::measure
