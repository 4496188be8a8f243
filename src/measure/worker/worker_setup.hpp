#pragma once
// Determines how the worker of a device is started: its command (with or without the emulator), its
// environment and its cache folder.

#include <chrono>
#include <string>
#include <vector>

#include "measure/system/environment.hpp"
#include "measure/worker/worker_slot.hpp"

namespace triptych::measure {

struct SideOptions {
  std::string device;
  // The command that starts a worker; the device id is appended. The program must call serve_worker
  // with Process::child_request_fd and child_answer_fd (measure/system/process.hpp).
  std::vector<std::string> command;
  // Environment variables ("NAME=VALUE") that are set before any driver is loaded, in addition to
  // those that every worker has.
  std::vector<std::string> environment = {};
};

// The time limit under the emulator, where the first compilation takes minutes instead of seconds.
inline constexpr std::chrono::seconds counted_limit{600};

// The default time limit for a configuration in a compile-only plan. The most expensive
// configuration (bvh with rusticl of Mesa 25.0.7) needs 8 s of processor time, but while eight busy
// processes shared two processors it took longer than the minute that other plans allow.
inline constexpr std::chrono::seconds compiled_limit{300};

// Returns the name of the worker's cache folder. A worker that runs under the emulator, and
// therefore compiles for another processor, or that has additional environment variables, has a
// separate folder. This is necessary because the keys in drivers' caches do not include everything
// that affects the code.
[[nodiscard]] std::string cache_name(const SideOptions& side, bool counted);

// `counted`: whether the worker runs under the emulator, if it is available. `limit`: the time
// limit for opening the device; if `counted` is true, counted_limit is used instead.
[[nodiscard]] WorkerSetup worker_setup(const SideOptions& side, bool counted,
                                       const CacheFolder& cache, std::chrono::milliseconds limit);

}  // namespace triptych::measure
