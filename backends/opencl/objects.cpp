#include "backends/opencl/objects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

#include "core/error.hpp"
#include "measure/contract/dump.hpp"

namespace triptych::opencl_backend {
namespace {

struct Code {
  cl_int value;
  std::string_view name;
};

#define TRI_CODE(name) \
  Code {               \
    name, #name        \
  }
constexpr std::array codes{
    TRI_CODE(CL_DEVICE_NOT_FOUND),
    TRI_CODE(CL_DEVICE_NOT_AVAILABLE),
    TRI_CODE(CL_COMPILER_NOT_AVAILABLE),
    TRI_CODE(CL_MEM_OBJECT_ALLOCATION_FAILURE),
    TRI_CODE(CL_OUT_OF_RESOURCES),
    TRI_CODE(CL_OUT_OF_HOST_MEMORY),
    TRI_CODE(CL_PROFILING_INFO_NOT_AVAILABLE),
    TRI_CODE(CL_MEM_COPY_OVERLAP),
    TRI_CODE(CL_IMAGE_FORMAT_MISMATCH),
    TRI_CODE(CL_IMAGE_FORMAT_NOT_SUPPORTED),
    TRI_CODE(CL_BUILD_PROGRAM_FAILURE),
    TRI_CODE(CL_MAP_FAILURE),
    TRI_CODE(CL_MISALIGNED_SUB_BUFFER_OFFSET),
    TRI_CODE(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST),
    TRI_CODE(CL_COMPILE_PROGRAM_FAILURE),
    TRI_CODE(CL_LINKER_NOT_AVAILABLE),
    TRI_CODE(CL_LINK_PROGRAM_FAILURE),
    TRI_CODE(CL_DEVICE_PARTITION_FAILED),
    TRI_CODE(CL_KERNEL_ARG_INFO_NOT_AVAILABLE),
    TRI_CODE(CL_INVALID_VALUE),
    TRI_CODE(CL_INVALID_DEVICE_TYPE),
    TRI_CODE(CL_INVALID_PLATFORM),
    TRI_CODE(CL_INVALID_DEVICE),
    TRI_CODE(CL_INVALID_CONTEXT),
    TRI_CODE(CL_INVALID_QUEUE_PROPERTIES),
    TRI_CODE(CL_INVALID_COMMAND_QUEUE),
    TRI_CODE(CL_INVALID_HOST_PTR),
    TRI_CODE(CL_INVALID_MEM_OBJECT),
    TRI_CODE(CL_INVALID_IMAGE_FORMAT_DESCRIPTOR),
    TRI_CODE(CL_INVALID_IMAGE_SIZE),
    TRI_CODE(CL_INVALID_SAMPLER),
    TRI_CODE(CL_INVALID_BINARY),
    TRI_CODE(CL_INVALID_BUILD_OPTIONS),
    TRI_CODE(CL_INVALID_PROGRAM),
    TRI_CODE(CL_INVALID_PROGRAM_EXECUTABLE),
    TRI_CODE(CL_INVALID_KERNEL_NAME),
    TRI_CODE(CL_INVALID_KERNEL_DEFINITION),
    TRI_CODE(CL_INVALID_KERNEL),
    TRI_CODE(CL_INVALID_ARG_INDEX),
    TRI_CODE(CL_INVALID_ARG_VALUE),
    TRI_CODE(CL_INVALID_ARG_SIZE),
    TRI_CODE(CL_INVALID_KERNEL_ARGS),
    TRI_CODE(CL_INVALID_WORK_DIMENSION),
    TRI_CODE(CL_INVALID_WORK_GROUP_SIZE),
    TRI_CODE(CL_INVALID_WORK_ITEM_SIZE),
    TRI_CODE(CL_INVALID_GLOBAL_OFFSET),
    TRI_CODE(CL_INVALID_EVENT_WAIT_LIST),
    TRI_CODE(CL_INVALID_EVENT),
    TRI_CODE(CL_INVALID_OPERATION),
    TRI_CODE(CL_INVALID_BUFFER_SIZE),
    TRI_CODE(CL_INVALID_GLOBAL_WORK_SIZE),
    TRI_CODE(CL_INVALID_IMAGE_DESCRIPTOR),
    TRI_CODE(CL_INVALID_COMPILER_OPTIONS),
    TRI_CODE(CL_INVALID_LINKER_OPTIONS),
    TRI_CODE(CL_INVALID_DEVICE_PARTITION_COUNT),
    Code{-1001, "CL_PLATFORM_NOT_FOUND_KHR"},
};
#undef TRI_CODE

// Returns whether the code means that the device was lost. After a fault in a kernel, every call
// that uses the queue of a GPU returns one of the last two codes.
bool means_lost(cl_int code) {
  return code == CL_DEVICE_NOT_AVAILABLE || code == CL_INVALID_COMMAND_QUEUE ||
         code == CL_OUT_OF_RESOURCES;
}

}  // namespace

std::string code_name(cl_int code) {
  const auto* found = std::ranges::find(codes, code, &Code::value);
  return found == codes.end() ? fmt::format("error {}", code) : std::string(found->name);
}

namespace {

// Keeps the entry in the ledger until the driver destroys the object. That may be later than the
// destruction of `object`, because there may be other references to the same OpenCL object.
void enter(cl::Memory& object, measure::MemoryLedger::Entry entry) {
  auto tracked = std::make_unique<measure::MemoryLedger::Entry>(std::move(entry));
  object.setDestructorCallback(
      [](cl_mem, void* data) { delete static_cast<measure::MemoryLedger::Entry*>(data); },
      tracked.get());
  static_cast<void>(tracked.release());
}

}  // namespace

cl::Buffer make_buffer(const Session& session, cl_mem_flags flags, std::size_t bytes,
                       core::CodePlace place) {
  try {
    cl::Buffer buffer(session.context, flags, bytes);
    enter(buffer, session.memory_ledger.buffer(bytes));
    return buffer;
  } catch (const cl::Error& error) {
    throw_api_error(error, place, fmt::format("for {} bytes", bytes));
  }
}

cl::Image3D make_image(const Session& session, const cl::ImageFormat& format,
                       const std::array<std::size_t, 3>& size, core::CodePlace place) {
  try {
    cl::Image3D image(session.context, CL_MEM_READ_ONLY, format, size[0], size[1], size[2]);
    enter(image, session.memory_ledger.image(image.getImageInfo<CL_IMAGE_ELEMENT_SIZE>() * size[0] *
                                             size[1] * size[2]));
    return image;
  } catch (const cl::Error& error) {
    throw_api_error(error, place, fmt::format("for {}x{}x{} texels", size[0], size[1], size[2]));
  }
}

void throw_api_error(const cl::Error& error, core::CodePlace place, const std::string& detail) {
  const std::string call = error.what();
  if (means_lost(error.err())) throw core::DeviceLost(call, code_name(error.err()), detail, place);
  throw core::ApiError(call, code_name(error.err()), detail, place);
}

void check_executed(const cl::Event& event, const std::string& call, const std::string& detail,
                    core::CodePlace place) {
  const auto read = [&] {
    return checked([&] { return event.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>(); }, place);
  };
  cl_int status = read();
  if (status > CL_COMPLETE) {
    // Some drivers complete events shortly after clFinish has returned. The feature probe
    // `event-status` reports such drivers.
    if (const cl_int code = ::clWaitForEvents(1, &event());
        code != CL_SUCCESS && code != CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST) {
      throw_api_error(cl::Error(code, "clWaitForEvents"), place, detail);
    }
    status = read();
  }
  if (status == CL_COMPLETE) return;
  if (status < 0) {
    const std::string ended = "the command was enqueued, but its execution failed";
    throw_api_error(cl::Error(status, call.c_str()), place,
                    detail.empty() ? ended : fmt::format("{}: {}", detail, ended));
  }
  throw core::ApiError(
      call, fmt::format("execution status {}", status),
      fmt::format("{}{}the command has not completed although triptych waited for its event",
                  detail, detail.empty() ? "" : ": "),
      place);
}

void write_buffer(const Session& session, const cl::Buffer& to, std::size_t offset,
                  std::size_t bytes, const void* from, core::CodePlace place) {
  if (measure::dump_folder())
    measure::write_dump("buffer", "bin", std::span(static_cast<const std::byte*>(from), bytes),
                        fmt::format("bytes {} to {} of a buffer", offset, offset + bytes));
  if (!session.queue.executes()) return;  // no command would set the event
  cl::Event event;
  checked(
      [&] { session.queue.enqueueWriteBuffer(to, CL_TRUE, offset, bytes, from, nullptr, &event); },
      place);
  check_executed(event, "clEnqueueWriteBuffer", {}, place);
}

void read_buffer(const Session& session, const cl::Buffer& from, std::size_t bytes, void* to,
                 core::CodePlace place) {
  cl::Event event;
  checked([&] { session.queue.enqueueReadBuffer(from, CL_TRUE, 0, bytes, to, nullptr, &event); },
          place);
  check_executed(event, "clEnqueueReadBuffer", {}, place);
}

void write_image(const Session& session, const cl::Image& to,
                 const std::array<cl::size_type, 3>& origin,
                 const std::array<cl::size_type, 3>& region, const void* from,
                 core::CodePlace place) {
  if (!session.queue.executes()) return;
  cl::Event event;
  checked(
      [&] {
        session.queue.enqueueWriteImage(to, CL_TRUE, origin, region, 0, 0, from, nullptr, &event);
      },
      place);
  check_executed(event, "clEnqueueWriteImage", {}, place);
}

void fill_buffer(const Session& session, const cl::Buffer& to, cl_uint word, std::size_t bytes,
                 core::CodePlace place) {
  if (!session.queue.executes()) return;
  cl::Event event;
  checked(
      [&] {
        session.queue.enqueueFillBuffer(to, word, 0, bytes, nullptr, &event);
        session.queue.finish();
      },
      place);
  check_executed(event, "clEnqueueFillBuffer", {}, place);
}

}  // namespace triptych::opencl_backend
