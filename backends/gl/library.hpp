#pragma once
#include <initializer_list>
#include <string>

namespace triptych::gl_backend {

// A shared library that is found at run time. It is never unloaded, because drivers keep threads
// and exit handlers.
class Library {
 public:
  // Opens the first of `names` that exists; otherwise throws core::NotSupported with the reason of
  // the loader.
  explicit Library(std::initializer_list<const char*> names);

  // The function `name`; null if the library does not have it.
  template <class Function>
  [[nodiscard]] Function find(const char* name) const {
    return reinterpret_cast<Function>(symbol(name));
  }
  // The same for a function that must exist; throws core::NotSupported otherwise.
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
