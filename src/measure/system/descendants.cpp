#include "measure/system/descendants.hpp"

#include <dirent.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace triptych::measure {
namespace {

// Returns the parent of a process, or 0 if the process has ended. In /proc/PID/stat, the name of
// the process is in parentheses and may contain any characters, so the fields after it begin at the
// last closing parenthesis.
pid_t parent_of(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  std::getline(file, text, '\0');
  const std::size_t name_end = text.rfind(')');
  if (name_end == std::string::npos || name_end + 4 > text.size()) return 0;
  return static_cast<pid_t>(std::strtol(text.c_str() + name_end + 4, nullptr, 10));
}

struct CloseFolder {
  void operator()(DIR* folder) const { ::closedir(folder); }
};

std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> children;
  const std::unique_ptr<DIR, CloseFolder> folder(::opendir("/proc"));
  if (!folder) return children;
  while (const dirent* entry = ::readdir(folder.get())) {
    const auto pid = static_cast<pid_t>(std::strtol(entry->d_name, nullptr, 10));
    if (pid > 0 && parent_of(pid) == parent) children.push_back(pid);
  }
  return children;
}

// The children of this process. There is only one object of this type, because children belong to
// the whole process.
struct Children {
  std::mutex mutex;
  bool inherits = false;
  std::set<pid_t> from_before;  // children of this process before it began to inherit
  std::set<pid_t> started;      // started by this process and not yet reaped
};

Children& children() {
  static Children all;
  return all;
}

// Kills the inherited processes. When a process is killed, this process inherits its children.
// Therefore the function repeats this until no inherited process is left. The number of rounds is
// limited, because processes may be started faster than they can be killed.
void kill_orphans(const Children& all) {
  constexpr int most_rounds = 200;
  for (int round = 0; round < most_rounds; ++round) {
    bool any = false;
    for (const pid_t pid : children_of(::getpid())) {
      if (all.from_before.contains(pid) || all.started.contains(pid)) continue;
      any = true;
      ::kill(pid, SIGKILL);
      ::waitpid(pid, nullptr, WNOHANG);
    }
    if (!any) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace

void inherit_orphans() {
  Children& all = children();
  const std::scoped_lock lock(all.mutex);
  if (all.inherits) return;
  const std::vector<pid_t> before = children_of(::getpid());
  all.from_before.insert(before.begin(), before.end());
  all.inherits = ::prctl(PR_SET_CHILD_SUBREAPER, 1) == 0;
}

// Holds the lock while the child is started. Otherwise another thread could mistake the new child
// for an inherited process and kill it.
int start_child(const std::function<int(pid_t*)>& spawn, pid_t& pid) {
  Children& all = children();
  const std::scoped_lock lock(all.mutex);
  const int error = spawn(&pid);
  if (error == 0) all.started.insert(pid);
  return error;
}

void forget_child(pid_t pid) noexcept {
  Children& all = children();
  const std::scoped_lock lock(all.mutex);
  all.started.erase(pid);
  if (all.inherits && all.started.empty()) kill_orphans(all);
}

}  // namespace triptych::measure
