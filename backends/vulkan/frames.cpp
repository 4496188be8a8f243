#include "backends/vulkan/frames.hpp"

#include <bit>
#include <chrono>
#include <limits>
#include <string_view>
#include <utility>

#include "measure/contract/not_drawn.hpp"

namespace triptych::vulkan_backend {
namespace {

struct Statistic {
  vk::QueryPipelineStatisticFlagBits flag;
  std::string_view name;  // the name in record::Counts
};

// The statistics in bit order, which is also the order in which a query returns them.
constexpr std::array<Statistic, 11> statistics_in_order{{
    {vk::QueryPipelineStatisticFlagBits::eInputAssemblyVertices, "input_assembly_vertices"},
    {vk::QueryPipelineStatisticFlagBits::eInputAssemblyPrimitives, "input_assembly_primitives"},
    {vk::QueryPipelineStatisticFlagBits::eVertexShaderInvocations, "vertex_invocations"},
    {vk::QueryPipelineStatisticFlagBits::eGeometryShaderInvocations, "geometry_invocations"},
    {vk::QueryPipelineStatisticFlagBits::eGeometryShaderPrimitives, "geometry_primitives"},
    {vk::QueryPipelineStatisticFlagBits::eClippingInvocations, "clipping_invocations"},
    {vk::QueryPipelineStatisticFlagBits::eClippingPrimitives, "clipping_primitives"},
    {vk::QueryPipelineStatisticFlagBits::eFragmentShaderInvocations, "fragment_invocations"},
    {vk::QueryPipelineStatisticFlagBits::eTessellationControlShaderPatches,
     "tessellation_control_patches"},
    {vk::QueryPipelineStatisticFlagBits::eTessellationEvaluationShaderInvocations,
     "tessellation_evaluation_invocations"},
    {vk::QueryPipelineStatisticFlagBits::eComputeShaderInvocations, "compute_invocations"},
}};

constexpr std::uint32_t timestamps = 2;
// The initial value of a timestamp, which the device overwrites. A clock does not return this value
// by chance, because the upper bits of a counter with fewer than 64 bits are 0, and a counter with
// 64 bits would need centuries to reach the value.
constexpr std::uint64_t unwritten_ticks = 0xFEEDFACE0BADF00D;

}  // namespace

Frames::Frames(const Gpu& gpu, vk::QueryPipelineStatisticFlags statistics, const Recording& timed)
    : gpu_(gpu),
      statistic_flags_(gpu.features.pipelineStatisticsQuery == VK_TRUE
                           ? statistics
                           : vk::QueryPipelineStatisticFlags{}),
      fence_(gpu.executes ? vk::raii::Fence(gpu.device, vk::FenceCreateInfo{})
                          : vk::raii::Fence(nullptr)),
      timed_(record(timed, vk::QueryType::eTimestamp, gpu.timestamp_bits > 0)),
      counted_by_driver_(
          record(timed, vk::QueryType::ePipelineStatistics, bool(statistic_flags_))) {}

void Frames::record_counters(const Recording& counting) {
  counters_ = record(counting, vk::QueryType::eTimestamp, false);
}

Frames::Recorded Frames::record(const Recording& work, vk::QueryType type, bool queried) const {
  // On a device that only compiles, nothing is submitted, so no commands are recorded and no
  // queries are created.
  if (!gpu_.executes) return {.commands = nullptr, .queries = nullptr};
  Recorded recorded{.commands = make_commands(gpu_), .queries = nullptr};
  const bool timing = type == vk::QueryType::eTimestamp;
  const vk::raii::CommandBuffer& commands = recorded.commands;
  commands.begin(vk::CommandBufferBeginInfo{});
  barrier(commands);
  if (!queried) {
    work(commands);
    commands.end();
    return recorded;
  }
  const std::uint32_t count = timing ? timestamps : 1;
  recorded.queries = {
      gpu_.device,
      vk::QueryPoolCreateInfo{
          .queryType = type,
          .queryCount = count,
          .pipelineStatistics = timing ? vk::QueryPipelineStatisticFlags{} : statistic_flags_}};
  commands.resetQueryPool(*recorded.queries, 0, count);
  if (timing) {
    commands.writeTimestamp(vk::PipelineStageFlagBits::eTopOfPipe, *recorded.queries, 0);
    work(commands);
    commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *recorded.queries, 1);
  } else {
    commands.beginQuery(*recorded.queries, 0, {});
    work(commands);
    commands.endQuery(*recorded.queries, 0);
  }
  commands.end();
  return recorded;
}

measure::Frame Frames::submit(measure::Purpose purpose) const {
  const Recorded* recorded = &timed_;
  if (purpose == measure::Purpose::statistics) recorded = &counted_by_driver_;
  if (purpose == measure::Purpose::counters) recorded = &counters_.value();
  gpu_.device.resetFences(*fence_);
  measure::Frame frame;
  const auto begin = std::chrono::steady_clock::now();
  submit_and_wait(gpu_, recorded->commands, fence_);
  const auto end = std::chrono::steady_clock::now();
  frame.wall_ns = std::chrono::duration<double, std::nano>(end - begin).count();
  if (purpose == measure::Purpose::timing) frame.device_ns = device_ns();
  if (purpose == measure::Purpose::statistics) frame.counts = statistics();
  return frame;
}

std::optional<double> Frames::device_ns() const {
  if (gpu_.timestamp_bits == 0) return std::nullopt;
  std::array<std::uint64_t, timestamps> ticks{unwritten_ticks, unwritten_ticks};
  const VkResult result = gpu_.device.getDispatcher()->vkGetQueryPoolResults(
      static_cast<VkDevice>(*gpu_.device), static_cast<VkQueryPool>(*timed_.queries), 0, timestamps,
      sizeof ticks, ticks.data(), sizeof ticks[0],
      VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
  if (result != VK_SUCCESS) return std::nullopt;
  // If the device did not write the timestamps, the device time is NaN, and the clock calibration
  // reports the clock as faulty.
  if (ticks[0] == unwritten_ticks || ticks[1] == unwritten_ticks) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  // The counter wraps around after `timestamp_bits` bits.
  const std::uint64_t mask = ~std::uint64_t{0} >> (64 - gpu_.timestamp_bits);
  const std::uint64_t elapsed = (ticks[1] - ticks[0]) & mask;
  return static_cast<double>(elapsed) * static_cast<double>(gpu_.properties.limits.timestampPeriod);
}

// Reads the query exactly once after each reset, because lavapipe adds the counts again at a second
// read.
record::Counts Frames::statistics() const {
  record::Counts counts;
  if (!statistic_flags_) return counts;
  const auto [result, values] =
      counted_by_driver_.queries.getResult<std::array<std::uint64_t, statistics_in_order.size()>>(
          0, 1, sizeof(std::uint64_t) * statistics_in_order.size(),
          vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
  if (result != vk::Result::eSuccess) {
    throw measure::StatisticsNotReady("vkGetQueryPoolResults", vk::to_string(result),
                                      "for pipeline statistics, despite VK_QUERY_RESULT_WAIT_BIT");
  }
  std::size_t at = 0;
  for (const Statistic& each : statistics_in_order) {
    if (statistic_flags_ & each.flag) counts.emplace(each.name, values.at(at++));
  }
  return counts;
}

}  // namespace triptych::vulkan_backend
