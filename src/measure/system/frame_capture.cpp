#include "measure/system/frame_capture.hpp"

#include <dlfcn.h>

#include <cstddef>
#include <cstdint>

namespace triptych::measure {
namespace {

// The positions of functions in the table that RENDERDOC_GetAPI returns for version 1.1.2 and
// later. New versions only append functions to the table.
constexpr int version = 10102;
enum Place : std::size_t { set_file = 11, start = 19, end = 21 };

template <class Function>
Function* function_at(const void* const* functions, Place place) {
  return reinterpret_cast<Function*>(const_cast<void*>(functions[place]));
}

const void* const* loaded_functions() {
  void* library = dlopen("librenderdoc.so", RTLD_NOW | RTLD_NOLOAD);
  if (library == nullptr) return nullptr;
  const auto get = reinterpret_cast<int (*)(int, void**)>(dlsym(library, "RENDERDOC_GetAPI"));
  void* functions = nullptr;
  if (get == nullptr || get(version, &functions) != 1) return nullptr;
  return static_cast<const void* const*>(functions);
}

}  // namespace

FrameCapture::FrameCapture(const std::string& file) : functions_(loaded_functions()) {
  if (functions_ == nullptr) return;
  if (!file.empty()) function_at<void(const char*)>(functions_, set_file)(file.c_str());
  function_at<void(void*, void*)>(functions_, start)(nullptr, nullptr);
}

FrameCapture::~FrameCapture() {
  if (functions_ != nullptr) {
    function_at<std::uint32_t(void*, void*)>(functions_, end)(nullptr, nullptr);
  }
}

}  // namespace triptych::measure
