#pragma once
// Kernel launches with their arguments and sizes, and the time that a sequence of them takes.

#include <fmt/format.h>

#include <chrono>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "backends/opencl/objects.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::opencl_backend {

// A kernel does not retain its arguments, so they must outlive it.
struct Launch {
  cl::Kernel kernel;
  std::string name;
  cl::NDRange global;
  cl::NDRange local;  // cl::NullRange: the driver's choice
};

// The name of a kernel, and the line of code that asks for it.
struct KernelName {
  KernelName(const char* its_name, core::CodePlace its_place = core::CodePlace::current())
      : name(its_name), place(its_place) {}
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

// A read-only buffer with a copy of `bytes`; it has 16 bytes if `bytes` is empty.
[[nodiscard]] cl::Buffer upload_bytes(const Session& session, std::span<const std::byte> bytes);

// Runs launches that are not timed, in their order, and waits for them. Throws core::ApiError,
// core::DeviceLost, also if one of the launches ended abnormally, which clFinish does not report.
void run_checked(const Session& session, const std::vector<Launch>& launches,
                 core::CodePlace place = core::CodePlace::current());

// The commands of the last frame, which is the frame that is timed.
class FrameRun {
 public:
  // Runs the launches in their order and waits without spinning. The launches have to exist until
  // check(). The frame has its wall time and, for Purpose::timing, the device's: from the beginning
  // of the first command to the end of the last one. The time between commands is included, as it
  // is for the other APIs. Throws core::ApiError, core::DeviceLost.
  [[nodiscard]] measure::Frame draw(const Session& session, const std::vector<Launch>& launches,
                                    measure::Purpose purpose,
                                    core::CodePlace place = core::CodePlace::current());
  // The same for commands that are not plain launches: `enqueue` gets the list of events to fill,
  // one for each command, and waits until the queue has finished.
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

  // Throws if a command of the last frame ended abnormally, which clFinish does not report. Call it
  // before the frame's result is read: the status of an event costs instructions in the driver that
  // must not be counted as the frame's.
  void check(core::CodePlace place = core::CodePlace::current()) const;

 private:
  [[nodiscard]] std::optional<double> device_ns() const;  // nullopt if the device reports no time

  std::vector<cl::Event> events_;
  const std::vector<Launch>* launches_ = nullptr;  // null: other commands
};

}  // namespace triptych::opencl_backend
