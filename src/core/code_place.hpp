#pragma once
// A replacement for std::source_location. Clang 14 does not support that class, but its clang-tidy
// must be able to check this code.

namespace triptych::core {

class CodePlace {
 public:
  // Returns the source location of the caller if this call is a default argument.
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
