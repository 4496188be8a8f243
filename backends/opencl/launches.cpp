#include "backends/opencl/launches.hpp"

#include <algorithm>

namespace triptych::opencl_backend {

std::size_t round_up(std::size_t n, std::size_t multiple) {
  return (n + multiple - 1) / multiple * multiple;
}

cl::Buffer upload_bytes(const Session& session, std::span<const std::byte> bytes) {
  constexpr std::size_t smallest = 16;  // a buffer of no bytes is an error
  const cl::Buffer buffer =
      make_buffer(session, CL_MEM_READ_ONLY, std::max(bytes.size(), smallest));
  if (!bytes.empty()) {
    write_buffer(session, buffer, 0, bytes.size(), bytes.data());
  }
  return buffer;
}

void run(const Session& session, const std::vector<Launch>& launches,
         std::vector<cl::Event>& events, core::CodePlace place) {
  events.resize(launches.size());
  std::size_t at = 0;
  try {
    for (; at < launches.size(); ++at) {
      session.queue.enqueueNDRangeKernel(launches[at].kernel, cl::NullRange, launches[at].global,
                                         launches[at].local, nullptr, &events[at]);
    }
    session.queue.finish();
  } catch (const cl::Error& error) {
    throw_api_error(error, place,
                    at < launches.size() ? fmt::format("kernel {}", launches[at].name) : "");
  }
}

void check_executed(const std::vector<Launch>& launches, const std::vector<cl::Event>& events,
                    core::CodePlace place) {
  for (std::size_t i = 0; i < launches.size(); ++i) {
    check_executed(events[i], "clEnqueueNDRangeKernel", fmt::format("kernel {}", launches[i].name),
                   place);
  }
}

void run_checked(const Session& session, const std::vector<Launch>& launches,
                 core::CodePlace place) {
  std::vector<cl::Event> events;
  run(session, launches, events, place);
  check_executed(launches, events, place);
}

std::optional<double> device_ns(const std::vector<cl::Event>& events) {
  if (events.empty()) return std::nullopt;
  cl_ulong start = 0;
  cl_ulong end = 0;
  try {
    events.front().getProfilingInfo(CL_PROFILING_COMMAND_START, &start);
    events.back().getProfilingInfo(CL_PROFILING_COMMAND_END, &end);
  } catch (const cl::Error& error) {
    if (error.err() == CL_PROFILING_INFO_NOT_AVAILABLE) return std::nullopt;
    throw;
  }
  if (end < start) return std::nullopt;
  return static_cast<double>(end - start);
}

}  // namespace triptych::opencl_backend
