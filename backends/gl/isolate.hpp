#pragma once
#include <chrono>
#include <functional>
#include <string>

namespace triptych::gl_backend {

struct Answer {
  std::string text;  // the text that the child returned
  std::string
      failure;  // the reason if there is no text: "crashed: Segmentation fault"; otherwise empty
};

// Runs `ask` in a child of this process, so that a library that it loads can neither crash the
// caller nor stay loaded in it. A child that has not finished after `limit` is killed. Nothing that
// the child does makes this throw.
[[nodiscard]] Answer ask_in_child(const std::function<std::string()>& ask,
                                  std::chrono::milliseconds limit);

}  // namespace triptych::gl_backend
