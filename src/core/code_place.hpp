#pragma once
// A replacement for std::source_location, which Clang 14 does not support. This code must compile
// with Clang 14 because clang-tidy 14 checks it.

namespace triptych::core {

class CodePlace {
 public:
  // When used as a default argument of a function, returns the source location of the call to that
  // function.
  [[nodiscard]] static constexpr CodePlace current(const char* file = __builtin_FILE(),
                                                   int line = __builtin_LINE()) noexcept {
    return CodePlace(file, line);
  }
  [[nodiscard]] constexpr const char* file_name() const noexcept { return file_; }
  [[nodiscard]] constexpr int line() const noexcept { return line_; }

 private:
  constexpr CodePlace(const char* file, int line) noexcept : file_(file), line_(line) {}

  const char* file_;
  int line_;
};

}  // namespace triptych::core
