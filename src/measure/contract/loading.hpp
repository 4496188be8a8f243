#pragma once
// Progress of loading a large data set: a suite reports it, a worker sends it to its supervisor,
// and the program shows it.

#include <chrono>
#include <functional>
#include <string>

namespace triptych::measure {

struct Loading {
  std::string what;  // the value of the factor `data`
  double share = 0;  // share that is done, in [0, 1]
  // A sentence about something in the data that had to be guessed or left out; usually empty.
  std::string note = {};
};

using OnLoading = std::function<void(const Loading&)>;

// Returns a function that forwards only useful reports to `tell`: none for a load shorter than two
// seconds; for others at most one report every two seconds, and the end (share 1) if the load was
// reported before. A report with another name or a smaller share than the previous one begins a new
// load. Tests replace `now`.
[[nodiscard]] OnLoading paced(
    OnLoading tell,
    std::function<std::chrono::steady_clock::time_point()> now = std::chrono::steady_clock::now);

}  // namespace triptych::measure
