// Driver faults outside of commands: lost submissions, crashes at exit, and changes to the state of
// the process.
#include <array>
#include <atomic>
#include <cfenv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "tests/layer/chain.hpp"
#include "tests/layer/change.hpp"

namespace triptych::layer {
namespace {

std::mutex mutex;
std::set<VkCommandBuffer> executed;  // command buffers that were executed since they were recorded
std::atomic<int> submissions = 0;

VKAPI_ATTR VkResult VKAPI_CALL begin_commands(VkCommandBuffer commands,
                                              const VkCommandBufferBeginInfo* info) {
  {
    const std::lock_guard lock(mutex);
    executed.erase(commands);
  }
  return next<PFN_vkBeginCommandBuffer>(commands, "vkBeginCommandBuffer")(commands, info);
}

// Returns whether a submission is skipped. With `once_only`, recorded commands are executed only
// when they are submitted for the first time. With `lost_frames=n`, every n-th submission is
// skipped.
bool is_left_out(VkCommandBuffer commands, int number) {
  if (is_requested("once_only")) {
    const std::lock_guard lock(mutex);
    return !executed.insert(commands).second;
  }
  return is_requested("lost_frames") &&
         number % static_cast<int>(requested_number("lost_frames")) == 0;
}

VKAPI_ATTR VkResult VKAPI_CALL submit(VkQueue queue, std::uint32_t count,
                                      const VkSubmitInfo* submits, VkFence fence) {
  const int number = ++submissions;
  if (is_requested("lost_after") && number > static_cast<int>(requested_number("lost_after"))) {
    return VK_ERROR_DEVICE_LOST;
  }
  std::vector<VkSubmitInfo> changed(submits, submits + count);
  for (VkSubmitInfo& each : changed) {
    if (each.commandBufferCount == 1 && is_left_out(each.pCommandBuffers[0], number)) {
      each.commandBufferCount = 0;
    }
  }
  return next<PFN_vkQueueSubmit>(queue, "vkQueueSubmit")(queue, count, changed.data(), fence);
}

[[noreturn]] void crash() {
  std::fprintf(stderr, "layer: crashing as TRIPTYCH_LAYER=%s says\n", requested().c_str());
  std::raise(SIGSEGV);  // runs the handler of the worker, which writes the call stack
  std::abort();
}

[[noreturn]] void hang() {
  std::fprintf(stderr, "layer: hanging as TRIPTYCH_LAYER=%s says\n", requested().c_str());
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

VKAPI_ATTR void VKAPI_CALL destroy_pipeline(VkDevice, VkPipeline, const VkAllocationCallbacks*) {
  crash();
}

// Runs at the end of the process, when the library is unloaded.
struct AtExit {
  // The changes are parsed before this object exists, so that they are destroyed after it.
  AtExit() { static_cast<void>(changes()); }
  ~AtExit() {
    if (is_requested("crash_at_exit") && submissions > 0) crash();
  }
};
const AtExit at_exit;

// Without this variable, a compiler could remove an allocation whose address is never used.
void* volatile last_leak = nullptr;

// Allocates host memory with every buffer, and never frees it.
VKAPI_ATTR VkResult VKAPI_CALL leak_with_buffer(VkDevice device, const VkBufferCreateInfo* info,
                                                const VkAllocationCallbacks* allocator,
                                                VkBuffer* buffer) {
  constexpr std::size_t bytes = std::size_t{8} << 20U;
  void* lost = std::malloc(bytes);
  if (lost != nullptr) std::memset(lost, 1, bytes);
  last_leak = lost;
  return next<PFN_vkCreateBuffer>(device, "vkCreateBuffer")(device, info, allocator, buffer);
}

VKAPI_ATTR VkResult VKAPI_CALL
compute_pipelines_after_rounding(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                 const VkComputePipelineCreateInfo* infos,
                                 const VkAllocationCallbacks* allocator, VkPipeline* pipelines) {
  std::fesetround(FE_UPWARD);
  return next<PFN_vkCreateComputePipelines>(device, "vkCreateComputePipelines")(
      device, cache, count, infos, allocator, pipelines);
}

constexpr const char* submits = "vkQueueSubmit";

}  // namespace

void end_device() {
  if (is_requested("crash_with_device")) crash();
  if (is_requested("hang_with_device")) hang();
}

std::span<const Hook> submission_hooks() {
  static const std::array hooks{
      hook("once_only", submits, &submit),
      hook("once_only", "vkBeginCommandBuffer", &begin_commands),
      hook("lost_frames", submits, &submit),
      hook("lost_after", submits, &submit),
      hook("crash_at_exit", submits, &submit),
      hook("crash_with_pipeline", "vkDestroyPipeline", &destroy_pipeline),
      hook("crash_with_device", submits, &submit),
      hook("hang_with_device", submits, &submit),
      hook("leak", "vkCreateBuffer", &leak_with_buffer),
      hook("rounding", "vkCreateComputePipelines", &compute_pipelines_after_rounding)};
  return hooks;
}

}  // namespace triptych::layer
