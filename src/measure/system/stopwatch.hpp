#pragma once
#include <chrono>

namespace triptych::measure {

// Measures the wall time since its construction.
class Stopwatch {
 public:
  [[nodiscard]] std::chrono::steady_clock::duration elapsed() const {
    return std::chrono::steady_clock::now() - start_;
  }
  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(elapsed()).count(); }
  [[nodiscard]] double ns() const {
    return std::chrono::duration<double, std::nano>(elapsed()).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace triptych::measure
