#pragma once
// What libraries throw, turned into errors of ours that say what they are about.

#include <string>
#include <utility>

namespace triptych::core {

// To be called where an exception is being handled. One of ours goes on as it is; any other becomes
// an IoError (the system's, memory) or an InputError that begins with `about`: a file, or a place
// in one. Without it the fault is taken for the program's own.
[[noreturn]] void rethrow_as_ours(const std::string& about);

// Runs `action`, whatever it throws being ours.
template <typename Action>
decltype(auto) naming(const std::string& about, Action&& action) {
  try {
    return std::forward<Action>(action)();
  } catch (...) {
    rethrow_as_ours(about);
  }
}

}  // namespace triptych::core
