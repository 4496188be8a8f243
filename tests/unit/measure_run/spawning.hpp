#pragma once
// Finds out whether posix_spawn() reports that a program is missing. Under QEMU's user-mode
// emulation, it does not, because the child of a vfork does not share memory with its parent, and
// exits with code 127 instead.

#include <spawn.h>
#include <sys/types.h>
#include <sys/wait.h>

namespace triptych::measure {

inline bool spawning_reports_a_missing_program() {
  char name[] = "/nowhere/program";
  char* words[] = {name, nullptr};
  pid_t child = 0;
  if (::posix_spawn(&child, name, nullptr, nullptr, words, nullptr) != 0) return true;
  ::waitpid(child, nullptr, 0);
  return false;
}

inline constexpr const char* spawning_does_not_report =
    "posix_spawn does not say that a program is missing, as under QEMU";

}  // namespace triptych::measure
