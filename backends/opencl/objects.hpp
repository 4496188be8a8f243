#pragma once
// The OpenCL objects are those of Khronos' C++ bindings: each counts its references through the API
// itself. Their exceptions know neither the code's name nor our place; checked() gives them both.

#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_TARGET_OPENCL_VERSION 120
#include <CL/opencl.hpp>
#include <array>
#include <string>
#include <utility>

#include "core/code_place.hpp"
#include "measure/contract/memory_ledger.hpp"

namespace triptych::opencl_backend {

// "CL_OUT_OF_RESOURCES" for −5; "error −1234" for a code that has no name here.
[[nodiscard]] std::string code_name(cl_int code);

// Throws core::DeviceLost for the codes with which drivers report that, else core::ApiError.
[[noreturn]] void throw_api_error(const cl::Error& error, core::CodePlace place,
                                  const std::string& detail = {});

// Runs a call of the API and turns its exception into ours.
template <typename Call>
decltype(auto) checked(Call&& call, core::CodePlace place = core::CodePlace::current()) {
  try {
    return std::forward<Call>(call)();
  } catch (const cl::Error& error) {
    throw_api_error(error, place);
  }
}

// A device that is open: what every call needs.
struct Session {
  cl::Device device;
  cl::Context context;
  cl::CommandQueue queue;  // in order, with profiling
  // Samples per batch of the kernels (volume.cl).
  int batch = 1;
  measure::MemoryLedger held = {};  // by what make_buffer and make_image made
};

// Both enter what they make into the session's ledger. Throw core::ApiError.
[[nodiscard]] cl::Buffer make_buffer(const Session& session, cl_mem_flags flags, std::size_t bytes,
                                     core::CodePlace place = core::CodePlace::current());
[[nodiscard]] cl::Image3D make_image(const Session& session, const cl::ImageFormat& format,
                                     const std::array<std::size_t, 3>& size,
                                     core::CodePlace place = core::CodePlace::current());

// Throws core::ApiError or core::DeviceLost where the command of an event ended abnormally, or has
// not ended although its queue has been waited for. `call`: that enqueued it; `detail`: about it.
void check_executed(const cl::Event& event, const std::string& call, const std::string& detail = {},
                    core::CodePlace place = core::CodePlace::current());

// The blocking commands, their events checked. Throw core::ApiError, core::DeviceLost.
void write_buffer(const Session& session, const cl::Buffer& to, std::size_t offset,
                  std::size_t bytes, const void* from,
                  core::CodePlace place = core::CodePlace::current());
void read_buffer(const Session& session, const cl::Buffer& from, std::size_t bytes, void* to,
                 core::CodePlace place = core::CodePlace::current());
void write_image(const Session& session, const cl::Image& to,
                 const std::array<cl::size_type, 3>& origin,
                 const std::array<cl::size_type, 3>& region, const void* from,
                 core::CodePlace place = core::CodePlace::current());
// Waits.
void fill_buffer(const Session& session, const cl::Buffer& to, cl_uint word, std::size_t bytes,
                 core::CodePlace place = core::CodePlace::current());

}  // namespace triptych::opencl_backend
