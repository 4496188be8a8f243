#pragma once

namespace triptych::measure {

// From now on, a signal that ends the process because of an error (SIGSEGV, SIGBUS, SIGILL, SIGFPE,
// SIGABRT) first writes the call stack of the thread to stderr, one frame on each line, with the
// names of exported functions if they are known. SIGUSR2 writes it without ending the process; a
// supervisor uses it to ask where a process hangs. A driver that sets its own handlers replaces
// these.
void write_stack_of_crashes();

}  // namespace triptych::measure
