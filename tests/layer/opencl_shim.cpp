// Simulates the fault of an OpenCL driver that TRIPTYCH_SHIM selects. The library is preloaded
// (LD_PRELOAD), so that Triptych calls its functions instead of the loader's.
#ifndef CL_TARGET_OPENCL_VERSION
#define CL_TARGET_OPENCL_VERSION 120
#endif
#include <CL/cl.h>
#include <dlfcn.h>

#include <cstdlib>
#include <map>
#include <mutex>
#include <set>
#include <string_view>

namespace {

bool is_requested(std::string_view fault) {
  const char* set = std::getenv("TRIPTYCH_SHIM");
  return set != nullptr && fault == set;
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

std::mutex mutex;
std::map<cl_kernel, int> launches;
// Events of launches that end abnormally. Entries are never removed, so if the driver reuses the
// handle of a released event, the new event also counts as abnormal.
std::set<cl_event> abnormal;
std::set<cl_event> late;  // events of launches for which nobody has waited

// Returns whether the fault affects this launch of a kernel. It affects every launch except the
// first.
bool repeated(cl_kernel kernel) {
  const std::lock_guard lock(mutex);
  return ++launches[kernel] > 1;
}

}  // namespace

extern "C" CL_API_ENTRY cl_int CL_API_CALL
clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                       const size_t* offset, const size_t* global, const size_t* local,
                       cl_uint waits, const cl_event* wait_list, cl_event* event) {
  const bool faulty =
      is_requested("once_only") || is_requested("abnormal_end") || is_requested("refused_launch");
  if (faulty && repeated(kernel)) {
    if (is_requested("refused_launch")) return CL_OUT_OF_RESOURCES;
    const cl_int code = real<decltype(clEnqueueMarkerWithWaitList)>("clEnqueueMarkerWithWaitList")(
        queue, waits, wait_list, event);
    if (is_requested("abnormal_end") && event != nullptr) {
      const std::lock_guard lock(mutex);
      abnormal.insert(*event);
    }
    return code;
  }
  const cl_int code = real<decltype(clEnqueueNDRangeKernel)>("clEnqueueNDRangeKernel")(
      queue, kernel, dimensions, offset, global, local, waits, wait_list, event);
  if (is_requested("late_events") && event != nullptr) {
    const std::lock_guard lock(mutex);
    late.insert(*event);
  }
  return code;
}

// Simulates drivers that complete events only after clFinish has returned.
extern "C" CL_API_ENTRY cl_int CL_API_CALL clWaitForEvents(cl_uint count, const cl_event* events) {
  const cl_int code = real<decltype(clWaitForEvents)>("clWaitForEvents")(count, events);
  const std::lock_guard lock(mutex);
  for (cl_uint i = 0; i < count; ++i) late.erase(events[i]);
  return code;
}

extern "C" CL_API_ENTRY cl_int CL_API_CALL clGetEventInfo(cl_event event, cl_event_info name,
                                                          size_t size, void* value,
                                                          size_t* size_out) {
  if (name == CL_EVENT_COMMAND_EXECUTION_STATUS && value != nullptr) {
    const std::lock_guard lock(mutex);
    if (abnormal.contains(event) || late.contains(event)) {
      *static_cast<cl_int*>(value) = late.contains(event) ? CL_SUBMITTED : CL_INVALID_MEM_OBJECT;
      if (size_out != nullptr) *size_out = sizeof(cl_int);
      return CL_SUCCESS;
    }
  }
  return real<decltype(clGetEventInfo)>("clGetEventInfo")(event, name, size, value, size_out);
}
