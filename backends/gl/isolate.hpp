#pragma once
#include <chrono>
#include <functional>
#include <string>

namespace triptych::gl_backend {

struct ChildResult {
  std::string text;  // the result of `task`
  std::string
      failure;  // why there is no result, such as "crashed: Segmentation fault"; otherwise empty
};

// Runs `task` in a child process, so that a library that `task` loads can neither crash the caller
// nor stay loaded in it. Kills the child if it has not finished after `limit`. A child that
// crashes, hangs or returns garbage never makes this function throw.
[[nodiscard]] ChildResult run_in_child(const std::function<std::string()>& task,
                                       std::chrono::milliseconds limit);

}  // namespace triptych::gl_backend
