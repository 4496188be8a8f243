#pragma once
// Kernels with their arguments and sizes, and the time that a sequence of them took.

#include <fmt/format.h>

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "backends/opencl/objects.hpp"

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

// Runs the launches in their order and waits without spinning. `events` gets one for each launch;
// pass them to check_executed() outside of what is timed. Throws core::ApiError, core::DeviceLost.
void run(const Session& session, const std::vector<Launch>& launches,
         std::vector<cl::Event>& events, core::CodePlace place = core::CodePlace::current());

// Throws if one of the launches that run() waited for ended abnormally, which clFinish does not
// report.
void check_executed(const std::vector<Launch>& launches, const std::vector<cl::Event>& events,
                    core::CodePlace place = core::CodePlace::current());

// Both together, for launches that are not timed.
void run_checked(const Session& session, const std::vector<Launch>& launches,
                 core::CodePlace place = core::CodePlace::current());

// The time on the device's clock from the beginning of the first launch to the end of the last one.
// The time between launches is included, as it is for the other APIs. nullopt if the device reports
// no time.
[[nodiscard]] std::optional<double> device_ns(const std::vector<cl::Event>& events);

}  // namespace triptych::opencl_backend
