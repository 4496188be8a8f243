#pragma once
// What a worker leaves behind. A driver may start processes that leave the worker's process group
// (setsid), which no signal to the group reaches. On Linux the supervisor becomes their parent when
// the worker ends (PR_SET_CHILD_SUBREAPER), and kills them then.

#include <sys/types.h>

#include <functional>

namespace triptych::measure {

// Makes this process the one that inherits what its descendants leave behind; to be called before a
// worker is started. Processes that are this process's children already are left alone for ever.
void inherit_orphans();

// Calls spawn(&pid), which starts a child that the caller reaps, and returns what it returns: 0, or
// an error code where nothing was started.
[[nodiscard]] int start_child(const std::function<int(pid_t*)>& spawn, pid_t& pid);
// That child was reaped. When it was the last of those, every process that was inherited meanwhile is
// killed and reaped: while other workers live, nobody can tell whose process it is.
void forget_child(pid_t pid) noexcept;

}  // namespace triptych::measure
