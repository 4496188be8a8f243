#pragma once
// Starts the worker of a device: its command (native or under the emulator), its environment and
// its cache folder.

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
  // Each is "NAME=VALUE". They are set in addition to what every worker gets, before any driver is
  // loaded.
  std::vector<std::string> environment = {};
};

// Compiling for the first time takes minutes under the emulator, where it takes seconds natively.
inline constexpr std::chrono::seconds counted_limit{600};

// The default time limit for a configuration in a compile-only plan. The most expensive
// configuration (bvh with rusticl of Mesa 25.0.7) needs 8 s of processor time, but while eight busy
// processes shared two processors it took longer than the minute that other plans allow.
inline constexpr std::chrono::seconds compiled_limit{300};

// The name of a cache folder. Code that is compiled for another processor, as under the emulator,
// or with other environment variables is kept in a separate folder, because drivers do not include
// everything that changes the code in the keys of their caches.
[[nodiscard]] std::string cache_name(const SideOptions& side, bool counted);

// `counted`: under the emulator, if there is one. `limit`: the time for opening the device; under
// the emulator it is counted_limit.
[[nodiscard]] WorkerSetup worker_setup(const SideOptions& side, bool counted,
                                       const CacheFolder& cache, std::chrono::milliseconds limit);

}  // namespace triptych::measure
