#pragma once
#include <chrono>
#include <functional>
#include <string>

namespace triptych::gl_backend {

struct Answer {
  std::string text;     // what the child returned
  std::string failure;  // why there is none: "crashed: Segmentation fault"; empty when there is one
};

// Runs `ask` in a child of this process, so that whatever it loads cannot take the caller down or
// stay behind in it. A child that is not done at `limit` is killed. Never throws for what the child
// does.
[[nodiscard]] Answer ask_in_child(const std::function<std::string()>& ask,
                                  std::chrono::milliseconds limit);

}  // namespace triptych::gl_backend
