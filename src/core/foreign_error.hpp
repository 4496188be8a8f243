#pragma once
// Converts exceptions of libraries to the errors of this project, with the name of the affected
// file or place.

#include <string>
#include <utility>

namespace triptych::core {

// Call this while an exception is being handled. An error of this project is thrown again
// unchanged. Any other one becomes an IoError (system errors, out of memory) or an InputError that
// begins with `about`, which names a file or a place in one. Without `about` it is regarded as a
// fault of the program itself.
[[noreturn]] void rethrow_as_ours(const std::string& about);

// Runs `action` and converts its exceptions in this way.
template <typename Action>
decltype(auto) naming(const std::string& about, Action&& action) {
  try {
    return std::forward<Action>(action)();
  } catch (...) {
    rethrow_as_ours(about);
  }
}

}  // namespace triptych::core
