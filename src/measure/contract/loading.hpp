#pragma once
// Progress of loading a large data set: a suite reports it, a worker sends it to its supervisor,
// and the program shows it.

#include <chrono>
#include <functional>
#include <string>

namespace triptych::measure {

struct Loading {
  std::string what;  // the value of the factor `data`
  double share = 0;  // share of the load that is done, in [0, 1]
  // A sentence about a property of the data that had to be guessed or ignored; usually empty.
  std::string note = {};
};

using OnLoading = std::function<void(const Loading&)>;

// Returns a function that forwards only useful reports to `tell`. It forwards none for a load
// shorter than two seconds. For a longer load, it forwards at most one report every two seconds,
// and the end of the load (share 1). A report whose name differs from the previous one, or whose
// share is smaller, begins a new load. Notes are forwarded once. Tests replace `now`.
[[nodiscard]] OnLoading paced(
    OnLoading tell,
    std::function<std::chrono::steady_clock::time_point()> now = std::chrono::steady_clock::now);

}  // namespace triptych::measure
