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
    session.queue.enqueueWriteBuffer(buffer, CL_TRUE, 0, bytes.size(), bytes.data());
  }
  return buffer;
}

void run(const Session& session, const std::vector<Launch>& launches,
         std::vector<cl::Event>& events) {
  events.resize(launches.size());
  for (std::size_t i = 0; i < launches.size(); ++i) {
    session.queue.enqueueNDRangeKernel(launches[i].kernel, cl::NullRange, launches[i].global,
                                       launches[i].local, nullptr, &events[i]);
  }
  session.queue.finish();
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
