#include "backends/opencl/launches.hpp"

#include <algorithm>

namespace triptych::opencl_backend {
namespace {

// Fills `events` with one event per launch.
void enqueue_all(const Session& session, const std::vector<Launch>& launches,
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

// `launches` is null if some events belong to commands other than kernel launches.
void check_all(const std::vector<cl::Event>& events, const std::vector<Launch>* launches,
               core::CodePlace place) {
  for (std::size_t at = 0; at < events.size(); ++at) {
    const std::string command = launches == nullptr
                                    ? fmt::format("command {} of {}", at + 1, events.size())
                                    : fmt::format("kernel {}", launches->at(at).name);
    check_executed(events[at], "clEnqueueNDRangeKernel", command, place);
  }
}

}  // namespace

std::size_t round_up(std::size_t n, std::size_t multiple) {
  return (n + multiple - 1) / multiple * multiple;
}

cl::Buffer upload_bytes(const Session& session, std::span<const std::byte> bytes) {
  constexpr std::size_t smallest = 16;  // OpenCL does not allow empty buffers
  const cl::Buffer buffer =
      make_buffer(session, CL_MEM_READ_ONLY, std::max(bytes.size(), smallest));
  if (!bytes.empty()) {
    write_buffer(session, buffer, 0, bytes.size(), bytes.data());
  }
  return buffer;
}

void run_checked(const Session& session, const std::vector<Launch>& launches,
                 core::CodePlace place) {
  std::vector<cl::Event> events;
  enqueue_all(session, launches, events, place);
  check_all(events, &launches, place);
}

measure::Frame FrameRun::draw(const Session& session, const std::vector<Launch>& launches,
                              measure::Purpose purpose, core::CodePlace place) {
  measure::Frame frame =
      draw(purpose, [&](auto& events) { enqueue_all(session, launches, events, place); });
  launches_ = &launches;
  return frame;
}

std::optional<double> FrameRun::device_ns() const {
  if (events_.empty()) return std::nullopt;
  cl_ulong start = 0;
  cl_ulong end = 0;
  try {
    events_.front().getProfilingInfo(CL_PROFILING_COMMAND_START, &start);
    events_.back().getProfilingInfo(CL_PROFILING_COMMAND_END, &end);
  } catch (const cl::Error& error) {
    if (error.err() == CL_PROFILING_INFO_NOT_AVAILABLE) return std::nullopt;
    throw;
  }
  if (end < start) return std::nullopt;
  return static_cast<double>(end - start);
}

void FrameRun::check(core::CodePlace place) const {
  check_all(events_, launches_, place);
}

}  // namespace triptych::opencl_backend
