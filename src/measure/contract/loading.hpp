#pragma once
// The progress of loading a large data set. A suite reports it, a worker sends it to its
// supervisor, and the program displays it.

#include <chrono>
#include <functional>
#include <string>

namespace triptych::measure {

struct Loading {
  std::string what;  // the value of the factor `data`
  double share = 0;  // completed fraction of the load, in [0, 1]
  // A sentence about a property of the data that had to be guessed or ignored. Usually empty.
  std::string note = {};
};

using OnLoading = std::function<void(const Loading&)>;

// Returns a function that forwards only useful reports to `forward`. If a load takes less than two
// seconds, no reports are forwarded. If it takes longer, at most one report every two seconds and
// the final report (share 1) are forwarded. A report counts as the beginning of a new load if its
// name differs from the name in the previous report, or if its share is smaller than the previous
// share. Each note is forwarded only once. Tests replace the clock `now`.
[[nodiscard]] OnLoading throttled(
    OnLoading forward,
    std::function<std::chrono::steady_clock::time_point()> now = std::chrono::steady_clock::now);

}  // namespace triptych::measure
