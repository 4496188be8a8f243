#pragma once
// Kernel launches with their arguments and sizes, and the time that a sequence of launches takes.

#include <fmt/format.h>

#include <chrono>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "backends/opencl/objects.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::opencl_backend {

// A kernel does not retain its arguments, so the arguments must outlive the launch.
struct Launch {
  cl::Kernel kernel;
  std::string name;
  cl::NDRange global;
  cl::NDRange local;  // cl::NullRange lets the driver choose
};

// The name of a kernel, and the source location where it is requested.
struct KernelName {
  KernelName(const char* kernel_name, core::CodePlace call_place = core::CodePlace::current())
      : name(kernel_name), place(call_place) {}
  const char* name;
  core::CodePlace place;
};

template <typename... Arguments>
[[nodiscard]] Launch make_launch(const cl::Program& program, const KernelName& kernel_name,
                                 const cl::NDRange& global, const cl::NDRange& local,
                                 const Arguments&... arguments) {
  try {
    cl::Kernel kernel(program, kernel_name.name);
    cl_uint index = 0;
    (kernel.setArg(index++, arguments), ...);
    return {
        .kernel = std::move(kernel), .name = kernel_name.name, .global = global, .local = local};
  } catch (const cl::Error& error) {
    throw_api_error(error, kernel_name.place, fmt::format("kernel {}", kernel_name.name));
  }
}

[[nodiscard]] std::size_t round_up(std::size_t n, std::size_t multiple);

// Creates a read-only buffer with a copy of `bytes`. The buffer has 16 bytes if `bytes` is empty.
[[nodiscard]] cl::Buffer upload_bytes(const Session& session, std::span<const std::byte> bytes);

// Runs launches that are not timed, in the given order, and waits for them. Throws core::ApiError
// or core::DeviceLost, also if a launch ended abnormally, which clFinish does not report.
void run_checked(const Session& session, const std::vector<Launch>& launches,
                 core::CodePlace place = core::CodePlace::current());

// The commands of the most recent frame.
class FrameRun {
 public:
  // Runs the launches in the given order and waits without spinning. The launches must exist until
  // check() is called. Returns the wall time of the frame and, for Purpose::timing, also the device
  // time, from the beginning of the first command to the end of the last command. As with the other
  // APIs, device time includes the time between commands. Throws core::ApiError or
  // core::DeviceLost.
  [[nodiscard]] measure::Frame draw(const Session& session, const std::vector<Launch>& launches,
                                    measure::Purpose purpose,
                                    core::CodePlace place = core::CodePlace::current());
  // Draws a frame that contains commands other than kernel launches. `enqueue` receives a list to
  // fill with one event per command, and must wait until the queue has finished.
  template <typename Enqueue>
  [[nodiscard]] measure::Frame draw(measure::Purpose purpose, const Enqueue& enqueue) {
    launches_ = nullptr;
    measure::Frame frame;
    const auto begin = std::chrono::steady_clock::now();
    enqueue(events_);
    const auto end = std::chrono::steady_clock::now();
    frame.wall_ns = std::chrono::duration<double, std::nano>(end - begin).count();
    if (purpose == measure::Purpose::timing) frame.device_ns = device_ns();
    return frame;
  }

  // Throws if a command of the most recent frame ended abnormally, which clFinish does not report.
  // Call this before reading the frame's result, but not while counting the frame's instructions,
  // because querying the status of an event executes instructions in the driver.
  void check(core::CodePlace place = core::CodePlace::current()) const;

 private:
  [[nodiscard]] std::optional<double> device_ns() const;  // nullopt if the device reports no time

  std::vector<cl::Event> events_;
  // Null if the most recent frame contained commands other than kernel launches.
  const std::vector<Launch>* launches_ = nullptr;
};

}  // namespace triptych::opencl_backend
