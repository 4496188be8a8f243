// Driver faults in measurements: timestamps and pipeline statistics.
#include <algorithm>
#include <array>
#include <csignal>
#include <map>
#include <mutex>

#include "tests/layer/chain.hpp"

namespace triptych::layer {
namespace {

std::mutex mutex;
std::map<VkQueryPool, VkQueryType> types;

VKAPI_ATTR VkResult VKAPI_CALL create_queries(VkDevice device, const VkQueryPoolCreateInfo* info,
                                              const VkAllocationCallbacks* allocator,
                                              VkQueryPool* pool) {
  const VkResult result =
      next<PFN_vkCreateQueryPool>(device, "vkCreateQueryPool")(device, info, allocator, pool);
  const std::lock_guard lock(mutex);
  types[*pool] = info->queryType;
  return result;
}

void stuck(std::span<std::uint64_t> values) {
  std::ranges::fill(values, values.front());
}

void doubled(std::span<std::uint64_t> values) {
  for (std::uint64_t& each : values) each *= 2;
}

void zero(std::span<std::uint64_t> values) {
  std::ranges::fill(values, 0);
}

// Simulates a clock whose ticks are ten times as long as the driver reports.
void slow(std::span<std::uint64_t> values) {
  values.back() = values.front() + (values.back() - values.front()) / 10;
}

// These faults do not change a result. Their functions are empty and serve only to identify the
// faults.
void crash(std::span<std::uint64_t>) {}
void not_ready(std::span<std::uint64_t>) {}
void untouched(std::span<std::uint64_t>) {}

// Calls `Corrupt` to change the 64-bit results of queries of the given type.
template <VkQueryType type, auto Corrupt>
VKAPI_ATTR VkResult VKAPI_CALL query_results(VkDevice device, VkQueryPool pool, std::uint32_t first,
                                             std::uint32_t count, std::size_t size, void* data,
                                             VkDeviceSize stride, VkQueryResultFlags flags) {
  const std::lock_guard lock(mutex);
  if (types[pool] == type && Corrupt == &crash) std::raise(SIGSEGV);
  if (types[pool] == type && Corrupt == &not_ready) return VK_NOT_READY;
  if (types[pool] == type && Corrupt == &untouched) return VK_SUCCESS;
  const VkResult result = next<PFN_vkGetQueryPoolResults>(device, "vkGetQueryPoolResults")(
      device, pool, first, count, size, data, stride, flags);
  if (types[pool] == type) {
    Corrupt(std::span(static_cast<std::uint64_t*>(data), size / sizeof(std::uint64_t)));
  }
  return result;
}

constexpr VkQueryType timestamps = VK_QUERY_TYPE_TIMESTAMP;
constexpr VkQueryType statistics = VK_QUERY_TYPE_PIPELINE_STATISTICS;

}  // namespace

std::span<const Hook> query_fault_hooks() {
  constexpr const char* creates = "vkCreateQueryPool";
  constexpr const char* reads = "vkGetQueryPoolResults";
  static const std::array hooks{
      hook("stuck_clock", creates, &create_queries),
      hook("stuck_clock", reads, &query_results<timestamps, &stuck>),
      hook("zero_clock", creates, &create_queries),
      hook("zero_clock", reads, &query_results<timestamps, &zero>),
      hook("wrong_period", creates, &create_queries),
      hook("wrong_period", reads, &query_results<timestamps, &slow>),
      hook("untouched_clock", creates, &create_queries),
      hook("untouched_clock", reads, &query_results<timestamps, &untouched>),
      hook("double_statistics", creates, &create_queries),
      hook("double_statistics", reads, &query_results<statistics, &doubled>),
      hook("zero_statistics", creates, &create_queries),
      hook("zero_statistics", reads, &query_results<statistics, &zero>),
      hook("crashing_statistics", creates, &create_queries),
      hook("crashing_statistics", reads, &query_results<statistics, &crash>),
      hook("unready_statistics", creates, &create_queries),
      hook("unready_statistics", reads, &query_results<statistics, &not_ready>)};
  return hooks;
}

}  // namespace triptych::layer
