#pragma once
// Runs the program so that one of its system calls fails. The call is selected by its number among
// those that can fail, so it is the same call in every run. Works on x86-64 Linux if a process may
// trace its child.

#include <fcntl.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <limits>

#include "killed.hpp"

namespace triptych::command_line {

struct Outcome {
  bool traced = true;  // false if tracing is not permitted on this machine, so that nothing was run
  // number of system calls by the first thread, after the start of the program, that could have
  // failed
  long calls = 0;
  int code = -1;  // exit code, or -1 if the program was killed by a signal
};

#if defined(__x86_64__)

namespace failing_detail {

// Returns the error with which the system call is made to fail, or 0 if the call does not concern
// files, memory or processes. If several errors are plausible, `number` selects one of them.
inline int error_of(unsigned long long call, long number) {
  switch (call) {
    case SYS_read:
    case SYS_pread64:
      return EIO;
    case SYS_write:
    case SYS_pwrite64:
    case SYS_ftruncate:
    case SYS_fsync:
    case SYS_fdatasync:
    case SYS_mkdir:
    case SYS_rename:
    case SYS_renameat2:
    case SYS_link:
    case SYS_linkat:
      return number % 2 == 0 ? ENOSPC : EIO;
    case SYS_openat:
    case SYS_open:
      return std::array{EACCES, EMFILE, ENOSPC}.at(static_cast<std::size_t>(number % 3));
    case SYS_unlink:
    case SYS_unlinkat:
    case SYS_rmdir:
    case SYS_newfstatat:
    case SYS_getdents64:
    case SYS_flock:
      return EACCES;
    case SYS_mmap:
    case SYS_mremap:
      return ENOMEM;
    case SYS_pipe2:
      return EMFILE;
    case SYS_vfork:
    case SYS_clone:
    case SYS_clone3:
      return EAGAIN;
    default:
      return 0;
  }
}

inline Outcome follow(pid_t child, long at) {
  Outcome outcome;
  long signal = 0;
  bool entering = true;
  bool started = false;  // before that, the dynamic loader is running
  int pending = 0;
  for (;;) {
    if (::ptrace(PTRACE_SYSCALL, child, 0, signal) != 0) throw std::runtime_error("ptrace");
    int status = 0;
    if (::waitpid(child, &status, __WALL) != child) throw std::runtime_error("waitpid");
    if (WIFEXITED(status)) outcome.code = WEXITSTATUS(status);
    if (WIFEXITED(status) || WIFSIGNALED(status)) return outcome;
    const bool call = WSTOPSIG(status) == (SIGTRAP | 0x80);
    signal = call ? 0 : WSTOPSIG(status) == SIGTRAP ? 0 : WSTOPSIG(status);
    if (!call) continue;
    user_regs_struct registers{};
    ::ptrace(PTRACE_GETREGS, child, 0, &registers);
    if (entering) {
      // The C library requests random bytes after all libraries are loaded. From then on, calls may
      // fail.
      started = started || registers.orig_rax == SYS_getrandom;
      const int error = started ? error_of(registers.orig_rax, at) : 0;
      if (error != 0 && ++outcome.calls == at) {
        pending = error;
        registers.orig_rax = ~0ULL;  // makes the kernel skip the call
        ::ptrace(PTRACE_SETREGS, child, 0, &registers);
      }
    } else if (pending != 0) {
      registers.rax = static_cast<unsigned long long>(-static_cast<long long>(pending));
      ::ptrace(PTRACE_SETREGS, child, 0, &registers);
      pending = 0;
    }
    entering = !entering;
  }
}

}  // namespace failing_detail

// `output_file` is the name of the file in `folder` to which the program's output is written.
inline Outcome run_failing(const std::filesystem::path& folder, const std::string& script,
                           const std::vector<std::string>& arguments,
                           const std::string& output_file,
                           long at = std::numeric_limits<long>::max()) {
  std::vector<std::string> words{TRIPTYCH_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const pid_t child = ::fork();
  if (child == 0) killed_detail::exec_traced(folder, script, output_file, words);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (!WIFSTOPPED(status)) return {.traced = false};
  ::ptrace(PTRACE_SETOPTIONS, child, 0, PTRACE_O_EXITKILL | PTRACE_O_TRACESYSGOOD);
  return failing_detail::follow(child, at);
}

#else

inline Outcome run_failing(const std::filesystem::path&, const std::string&,
                           const std::vector<std::string>&, const std::string&, long = 0) {
  return {.traced = false};
}

#endif

}  // namespace triptych::command_line
