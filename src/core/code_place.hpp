#pragma once
// A replacement for std::source_location that Clang 14 can parse, because its clang-tidy checks
// this code.

namespace triptych::core {

class CodePlace {
 public:
  // The place of the caller, when used as a default argument.
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
