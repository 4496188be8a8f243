#pragma once
// Ends processes that a worker leaves behind. A driver may start processes that leave the worker's
// process group (setsid()), so that no signal to the group reaches them. On Linux, the supervisor
// becomes their parent when the worker ends (PR_SET_CHILD_SUBREAPER), and then kills them.

#include <sys/types.h>

#include <functional>

namespace triptych::measure {

// Makes this process inherit the orphaned processes of its descendants. Must be called before a
// worker is started. Processes that are already children of this process are not affected.
void inherit_orphans();

// Calls spawn(&pid), which must start a child process. The caller must reap this child. Returns the
// result of spawn: 0, or an error code if no process was started.
[[nodiscard]] int start_child(const std::function<int(pid_t*)>& spawn, pid_t& pid);
// Must be called after a child was reaped. If no other child is left, kills and reaps all processes
// that were inherited in the meantime. They are not killed any earlier, because it is unknown to
// which of the remaining workers an inherited process belongs.
void forget_child(pid_t pid) noexcept;

}  // namespace triptych::measure
