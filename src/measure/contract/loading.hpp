#pragma once
// Telling how far the loading of a large data set has come: a suite says it, a worker hands it to
// its supervisor, the program shows it.

#include <chrono>
#include <functional>
#include <string>

namespace triptych::measure {

struct Loading {
  std::string what;  // the `data` factor
  double share = 0;  // done, in [0, 1]
};

using OnLoading = std::function<void(const Loading&)>;

// Hands on to `tell` what is worth a word: nothing of a load shorter than two seconds, of others
// one word every two seconds at most, and the end (share 1) of those of which a word was said. A
// load begins with another name or a smaller share than the last. `now` is for tests.
[[nodiscard]] OnLoading paced(
    OnLoading tell,
    std::function<std::chrono::steady_clock::time_point()> now = std::chrono::steady_clock::now);

}  // namespace triptych::measure
