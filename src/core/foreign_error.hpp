#pragma once
// Converts exceptions thrown by libraries to this project's error types, and adds the name of the
// file, or the place in the file, that caused them.

#include <string>
#include <utility>

namespace triptych::core {

// Must be called from a catch block. Rethrows an error of this project unchanged. Converts system
// errors and std::bad_alloc to IoError, and all other exceptions to InputError. The message begins
// with `about`, the name of a file or of a place in a file. If `about` is empty, an exception that
// would become an InputError is reported as an internal error of Triptych instead.
[[noreturn]] void rethrow_converted(const std::string& about);

// Runs `action` and converts its exceptions with rethrow_converted().
template <typename Action>
decltype(auto) with_error_context(const std::string& about, Action&& action) {
  try {
    return std::forward<Action>(action)();
  } catch (...) {
    rethrow_converted(about);
  }
}

}  // namespace triptych::core
