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
[[noreturn]] void throw_api_error(const cl::Error& error, core::CodePlace place);

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

// Both enter what they make into the session's ledger. Throw cl::Error.
[[nodiscard]] cl::Buffer make_buffer(const Session& session, cl_mem_flags flags, std::size_t bytes);
[[nodiscard]] cl::Image3D make_image(const Session& session, const cl::ImageFormat& format,
                                     const std::array<std::size_t, 3>& size);

}  // namespace triptych::opencl_backend
