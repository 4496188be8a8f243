#pragma once
// Determines how the worker of a device is started: its command (with or without the emulator that
// counts instructions, counting/emulator.hpp), its environment and its cache folder.

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "measure/system/environment.hpp"
#include "measure/worker/worker_slot.hpp"

namespace triptych::measure {

struct SideOptions {
  std::string device;
  // The command that starts a worker. The device id is appended to it. The program must call
  // serve_worker() with Process::child_request_fd and Process::child_answer_fd
  // (measure/system/process.hpp).
  std::vector<std::string> command;
  // Environment variables ("NAME=VALUE") that are set before any driver is loaded, in addition to
  // the variables that every worker has.
  std::vector<std::string> environment = {};
};

// The time limit for a configuration under the emulator, where the first compilation takes minutes
// instead of seconds.
inline constexpr std::chrono::seconds counted_limit{600};

// The default time limit for a configuration in a compile-only plan. It is longer than that of
// other plans, which is one minute. The most expensive configuration (the technique bvh, compiled
// by rusticl of Mesa 25.0.7) needs 8 s of CPU time, but took more than a minute while eight busy
// processes shared two CPU cores.
inline constexpr std::chrono::seconds compiled_limit{300};

// Returns the name of the worker's cache folder. A worker has a separate folder if it runs under
// the emulator, because it then compiles for another CPU, and if it has additional environment
// variables. Separate folders are necessary because the keys in drivers' caches do not include
// everything that affects the code.
[[nodiscard]] std::string cache_name(const SideOptions& side, bool counted);

// Returns the setup of a worker. `counted` states whether the worker is to run under the emulator,
// if the emulator is available. `limit` is the time limit for opening the device; if `counted` is
// true, counted_limit is used instead.
[[nodiscard]] WorkerSetup worker_setup(const SideOptions& side, bool counted,
                                       const CacheFolder& cache, std::chrono::milliseconds limit);

// Returns the setup of a worker that runs without the emulator, and fills the cache folder of the
// worker under the emulator with compiled code. Returns nullopt if this is impossible for the
// device.
[[nodiscard]] std::optional<WorkerSetup> ahead_setup(const SideOptions& side,
                                                     const CacheFolder& cache,
                                                     std::chrono::milliseconds limit);

}  // namespace triptych::measure
