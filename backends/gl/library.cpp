#include "backends/gl/library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include "core/error.hpp"

namespace triptych::gl_backend {

Library::Library(std::initializer_list<const char*> names) {
  std::string reason;
  for (const char* name : names) {
    // RTLD_LOCAL is needed because OSMesa and the Mesa library behind EGL define the same symbols.
    handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (handle_ != nullptr) {
      name_ = name;
      return;
    }
    if (const char* said = dlerror(); said != nullptr && reason.empty()) reason = said;
  }
  throw core::NotSupported(reason);
}

void* Library::symbol(const char* name) const {
  return dlsym(handle_, name);
}

void* Library::required(const char* name) const {
  void* found = symbol(name);
  if (found == nullptr)
    throw core::NotSupported(fmt::format("{} lacks the function {}", name_, name));
  return found;
}

}  // namespace triptych::gl_backend
