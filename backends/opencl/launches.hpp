#pragma once
// Kernels with their arguments and sizes, and the time a run of them took.

#include <fmt/format.h>

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "backends/opencl/objects.hpp"

namespace triptych::opencl_backend {

// A kernel does not retain its arguments: they must outlive it.
struct Launch {
  cl::Kernel kernel;
  std::string name;
  cl::NDRange global;
  cl::NDRange local;  // cl::NullRange: the driver's choice
};

// The name of a kernel, and where the code stands that asks for it.
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

// A read-only buffer that holds a copy of `bytes`; of 16 bytes where there are none.
[[nodiscard]] cl::Buffer upload_bytes(const Session& session, std::span<const std::byte> bytes);

// Runs the launches in their order and waits without spinning. `events`: one for each, to be given
// to check_executed() outside of what is timed. Throws core::ApiError, core::DeviceLost.
void run(const Session& session, const std::vector<Launch>& launches,
         std::vector<cl::Event>& events, core::CodePlace place = core::CodePlace::current());

// Throws where one of the launches that run() waited for ended abnormally: clFinish tells of none.
void check_executed(const std::vector<Launch>& launches, const std::vector<cl::Event>& events,
                    core::CodePlace place = core::CodePlace::current());

// Both together, where nothing is timed.
void run_checked(const Session& session, const std::vector<Launch>& launches,
                 core::CodePlace place = core::CodePlace::current());

// Time on the device's clock from the start of the first to the end of the last, as the other APIs
// stamp a frame: what lies between launches is part of it. Absent where the device tells none.
[[nodiscard]] std::optional<double> device_ns(const std::vector<cl::Event>& events);

}  // namespace triptych::opencl_backend
