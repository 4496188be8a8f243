#pragma once
// OpenCL objects are represented by the classes of Khronos' C++ bindings, which count references
// through the API. The exceptions of these bindings contain neither the name of the error code nor
// the source location of the call; checked() adds both.

#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_TARGET_OPENCL_VERSION 120
#include <CL/opencl.hpp>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/code_place.hpp"
#include "core/error.hpp"
#include "measure/contract/memory_ledger.hpp"
#include "measure/system/compile_only.hpp"

namespace triptych::opencl_backend {

// Returns "CL_OUT_OF_RESOURCES" for −5, for example, and "error −1234" for a code without a known
// name.
[[nodiscard]] std::string code_name(cl_int code);

// Throws core::DeviceLost for the error codes by which drivers report a lost device, and
// core::ApiError otherwise.
[[noreturn]] void throw_api_error(const cl::Error& error, core::CodePlace place,
                                  const std::string& detail = {});

// Calls the API and converts its exception to core::ApiError or core::DeviceLost.
template <typename Call>
decltype(auto) checked(Call&& call, core::CodePlace place = core::CodePlace::current()) {
  try {
    return std::forward<Call>(call)();
  } catch (const cl::Error& error) {
    throw_api_error(error, place);
  }
}

// A command queue. On a device that only compiles, because its GPU is not present, commands that
// execute work or read results throw core::NotSupported, and commands that upload data do nothing.
// The backend enqueues all commands through this class, whose functions have the same names as
// those of cl::CommandQueue.
class Queue {
 public:
  Queue(cl::CommandQueue queue, bool executes = true)  // NOLINT: implicit
      : queue_(std::move(queue)), executes_(executes) {}
  [[nodiscard]] bool executes() const noexcept { return executes_; }

  using Events = std::vector<cl::Event>;
  void enqueueWriteBuffer(const cl::Buffer& buffer, cl_bool blocking, std::size_t offset,
                          std::size_t size, const void* data, const Events* after = nullptr,
                          cl::Event* event = nullptr) const {
    if (executes_) queue_.enqueueWriteBuffer(buffer, blocking, offset, size, data, after, event);
  }
  void enqueueWriteImage(const cl::Image& image, cl_bool blocking,
                         const std::array<cl::size_type, 3>& origin,
                         const std::array<cl::size_type, 3>& region, std::size_t row_pitch,
                         std::size_t slice_pitch, const void* data, const Events* after = nullptr,
                         cl::Event* event = nullptr) const {
    if (!executes_) return;
    queue_.enqueueWriteImage(image, blocking, origin, region, row_pitch, slice_pitch, data, after,
                             event);
  }
  template <typename Pattern>
  void enqueueFillBuffer(const cl::Buffer& buffer, Pattern pattern, std::size_t offset,
                         std::size_t size, const Events* after = nullptr,
                         cl::Event* event = nullptr) const {
    if (executes_) queue_.enqueueFillBuffer(buffer, pattern, offset, size, after, event);
  }
  void enqueueNDRangeKernel(const cl::Kernel& kernel, const cl::NDRange& offset,
                            const cl::NDRange& global, const cl::NDRange& local = cl::NullRange,
                            const Events* after = nullptr, cl::Event* event = nullptr) const {
    require_execution();
    queue_.enqueueNDRangeKernel(kernel, offset, global, local, after, event);
  }
  void enqueueReadBuffer(const cl::Buffer& buffer, cl_bool blocking, std::size_t offset,
                         std::size_t size, void* data, const Events* after = nullptr,
                         cl::Event* event = nullptr) const {
    require_execution();
    queue_.enqueueReadBuffer(buffer, blocking, offset, size, data, after, event);
  }
  void finish() const {
    if (executes_) queue_.finish();
  }

 private:
  void require_execution() const {
    if (!executes_) throw core::NotSupported(std::string(measure::only_compiles));
  }

  cl::CommandQueue queue_;
  bool executes_;
};

// An open device, with all objects that API calls need.
struct Session {
  cl::Device device;
  cl::Context context;
  Queue queue;  // an in-order queue with profiling
  // The number of samples of a ray that a work item processes together (TRI_BATCH in raycast.cl).
  int batch = 1;
  // The memory of the objects that make_buffer and make_image created.
  measure::MemoryLedger memory_ledger = {};
};

// make_buffer() and make_image() record the new object in the session's ledger. They throw
// core::ApiError.
[[nodiscard]] cl::Buffer make_buffer(const Session& session, cl_mem_flags flags, std::size_t bytes,
                                     core::CodePlace place = core::CodePlace::current());
[[nodiscard]] cl::Image3D make_image(const Session& session, const cl::ImageFormat& format,
                                     const std::array<std::size_t, 3>& size,
                                     core::CodePlace place = core::CodePlace::current());

// Throws core::ApiError or core::DeviceLost if the command of an event ended abnormally, or has not
// completed although the program waited for the queue. `call` is the API call that enqueued the
// command, and `detail` describes the command.
void check_executed(const cl::Event& event, const std::string& call, const std::string& detail = {},
                    core::CodePlace place = core::CodePlace::current());

// Blocking commands whose events are checked. They throw core::ApiError or core::DeviceLost.
void write_buffer(const Session& session, const cl::Buffer& to, std::size_t offset,
                  std::size_t bytes, const void* from,
                  core::CodePlace place = core::CodePlace::current());
void read_buffer(const Session& session, const cl::Buffer& from, std::size_t bytes, void* to,
                 core::CodePlace place = core::CodePlace::current());
void write_image(const Session& session, const cl::Image& to,
                 const std::array<cl::size_type, 3>& origin,
                 const std::array<cl::size_type, 3>& region, const void* from,
                 core::CodePlace place = core::CodePlace::current());
// Fills the buffer, and waits until the fill has finished.
void fill_buffer(const Session& session, const cl::Buffer& to, cl_uint word, std::size_t bytes,
                 core::CodePlace place = core::CodePlace::current());

}  // namespace triptych::opencl_backend
