#pragma once
#include <initializer_list>
#include <string>

namespace triptych::gl_backend {

// A shared library that is loaded at run time. It is never unloaded, because drivers leave threads
// and exit handlers behind.
class Library {
 public:
  // Opens the first of `names` that exists. If none exists, throws core::NotSupported with the
  // loader's error message.
  explicit Library(std::initializer_list<const char*> names);

  // Returns the function `name`, or null if the library does not contain it.
  template <class Function>
  [[nodiscard]] Function find(const char* name) const {
    return reinterpret_cast<Function>(symbol(name));
  }
  // Returns the function `name`. Throws core::NotSupported if the library does not contain it.
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
