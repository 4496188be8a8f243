#pragma once
// Runs the program and kills it at a system call with a given number, which is the same point in
// every run.

#include <fcntl.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace triptych::command_line {

struct Ending {
  bool traced = true;  // false if tracing is not permitted on this machine, so that nothing was run
  bool killed = false;
  long calls = 0;  // number of times that the first thread entered or left the kernel
};

namespace killed_detail {

// Turns this process into the program. Exits with code 126 if tracing is not permitted.
[[noreturn]] inline void exec_traced(const std::filesystem::path& folder, const std::string& script,
                                     const std::string& output_file,
                                     const std::vector<std::string>& arguments) {
  std::vector<char*> words;
  for (const std::string& each : arguments) words.push_back(const_cast<char*>(each.c_str()));
  words.push_back(nullptr);
  const int out = ::open((folder / output_file).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::setenv("TRIPTYCH_NULL_SCRIPT", script.c_str(), 1);
  ::setenv("TRIPTYCH_DATA", "", 1);
  // The leak check of a sanitizer also uses tracing, so it is disabled.
  ::setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
  const bool ready = out >= 0 && ::dup2(out, 1) >= 0 && ::dup2(out, 2) >= 0 &&
                     ::chdir(folder.c_str()) == 0 && ::ptrace(PTRACE_TRACEME, 0, 0, 0) == 0;
  if (ready) ::execv(words.front(), words.data());
  std::_Exit(126);
}

// Lets the program run until it has entered and left the kernel `at` times, then kills it.
inline Ending follow(pid_t child, long at) {
  Ending ending;
  long signal = 0;
  for (;;) {
    if (::ptrace(PTRACE_SYSCALL, child, 0, signal) != 0) throw std::runtime_error("ptrace");
    int status = 0;
    if (::waitpid(child, &status, __WALL) != child) throw std::runtime_error("waitpid");
    if (WIFEXITED(status) || WIFSIGNALED(status)) return ending;
    const bool call = WSTOPSIG(status) == (SIGTRAP | 0x80);
    signal = call ? 0 : WSTOPSIG(status);
    if (!call || ++ending.calls < at) continue;
    ::kill(child, SIGKILL);
    ::waitpid(child, &status, __WALL);
    ending.killed = true;
    return ending;
  }
}

}  // namespace killed_detail

// `output_file` is the name of the file in `folder` to which the program's output is written.
inline Ending run_killed(const std::filesystem::path& folder, const std::string& script,
                         const std::vector<std::string>& arguments, const std::string& output_file,
                         long at = std::numeric_limits<long>::max()) {
  std::vector<std::string> words{TRIPTYCH_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const pid_t child = ::fork();
  if (child == 0) killed_detail::exec_traced(folder, script, output_file, words);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (!WIFSTOPPED(status)) return {.traced = false};
  ::ptrace(PTRACE_SETOPTIONS, child, 0, PTRACE_O_EXITKILL | PTRACE_O_TRACESYSGOOD);
  return killed_detail::follow(child, at);
}

}  // namespace triptych::command_line
