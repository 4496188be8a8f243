#pragma once
// How a device's worker is started: its command, natively or under the emulator, its environment
// and its cache folder.

#include <chrono>
#include <string>
#include <vector>

#include "measure/system/environment.hpp"
#include "measure/worker/worker_slot.hpp"

namespace triptych::measure {

struct SideOptions {
  std::string device;
  // Starts a worker; the device id is appended. It must call serve_worker with
  // Process::child_request_fd and child_answer_fd (measure/system/process.hpp).
  std::vector<std::string> command;
  // "NAME=VALUE" each, over what a worker gets anyway; there before any driver is loaded.
  std::vector<std::string> environment = {};
};

// Compiling for the first time takes the emulator minutes where it takes a processor seconds.
inline constexpr std::chrono::seconds counted_limit{600};

// Code is kept apart where it is made for another processor, as under the emulator, or with other
// variables: drivers do not put all that changes it into their caches' keys.
[[nodiscard]] std::string cache_name(const SideOptions& side, bool counted);

// `counted`: under the emulator, where there is one. `limit`: of opening the device; under the
// emulator it is counted_limit.
[[nodiscard]] WorkerSetup worker_setup(const SideOptions& side, bool counted,
                                       const CacheFolder& cache, std::chrono::milliseconds limit);

}  // namespace triptych::measure
