#pragma once
#include <initializer_list>
#include <string>

namespace triptych::gl_backend {

// A shared library found at run time. It is never unloaded: drivers keep threads and exit handlers.
class Library {
 public:
  // Opens the first of `names` that is there; throws core::NotSupported with the loader's reason.
  explicit Library(std::initializer_list<const char*> names);

  // The function `name`; null when the library has none.
  template <class Function>
  [[nodiscard]] Function find(const char* name) const {
    return reinterpret_cast<Function>(symbol(name));
  }
  // The same, where it must be there; throws core::NotSupported.
  template <class Function>
  [[nodiscard]] Function get(const char* name) const {
    return reinterpret_cast<Function>(required(name));
  }

 private:
  [[nodiscard]] void* symbol(const char* name) const;
  [[nodiscard]] void* required(const char* name) const;
  void* handle_ = nullptr;
  std::string name_;
};

}  // namespace triptych::gl_backend
