#pragma once
// Kernels with their arguments and sizes, and the time a run of them took.

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
  cl::NDRange global;
  cl::NDRange local;  // cl::NullRange: the driver's choice
};

template <typename... Arguments>
[[nodiscard]] Launch make_launch(const cl::Program& program, const std::string& name,
                                 const cl::NDRange& global, const cl::NDRange& local,
                                 const Arguments&... arguments) {
  cl::Kernel kernel(program, name.c_str());
  cl_uint index = 0;
  (kernel.setArg(index++, arguments), ...);
  return {.kernel = std::move(kernel), .global = global, .local = local};
}

[[nodiscard]] std::size_t round_up(std::size_t n, std::size_t multiple);

// A read-only buffer that holds a copy of `bytes`; of 16 bytes where there are none.
[[nodiscard]] cl::Buffer upload_bytes(const Session& session, std::span<const std::byte> bytes);

// Runs the launches in their order and waits without spinning. `events`: one for each.
void run(const Session& session, const std::vector<Launch>& launches,
         std::vector<cl::Event>& events);

// Time on the device's clock from the start of the first to the end of the last, as the other APIs
// stamp a frame: what lies between launches is part of it. Absent where the device tells none.
[[nodiscard]] std::optional<double> device_ns(const std::vector<cl::Event>& events);

}  // namespace triptych::opencl_backend
