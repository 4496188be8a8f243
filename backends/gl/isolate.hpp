#pragma once
#include <chrono>
#include <functional>
#include <string>

namespace triptych::gl_backend {

struct Answer {
  std::string text;  // the result of `ask`
  std::string
      failure;  // why there is no result, such as "crashed: Segmentation fault"; otherwise empty
};

// Runs `ask` in a child process, so that a library that `ask` loads can neither crash the caller
// nor stay loaded in it. Kills the child if it has not finished after `limit`. A child that
// crashes, hangs or returns garbage never makes this function throw.
[[nodiscard]] Answer ask_in_child(const std::function<std::string()>& ask,
                                  std::chrono::milliseconds limit);

}  // namespace triptych::gl_backend
