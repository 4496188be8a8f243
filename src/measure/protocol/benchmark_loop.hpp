#pragma once
// Runs the timed loops with Google Benchmark. Only one benchmark is registered at a time, and it is
// removed after it has run. Google Benchmark prints nothing, but its JSON entries are kept, so that
// tools for Google Benchmark can process them.

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace triptych::measure {

// Initializes Google Benchmark and makes it independent of its environment variables (BENCHMARK_*).
// The call is cheap and may be repeated.
void initialize_benchmarks();

struct BenchmarkResult {
  double total_ns = 0;  // total time of all iterations and repetitions
  // An array with the entries of the repetitions, followed by the entries of mean, median, minimum,
  // quartiles, …
  nlohmann::json entries;
};

// The result of one iteration: its time, and further values with the keys under which they are
// added to the JSON entry of the iteration.
struct IterationTime {
  double ns = 0;
  std::map<std::string, double> facts;
};

// Runs each frame as a separate repetition, whose time is the time that `frame` returns
// (UseManualTime()). The JSON contains every sample and the library's statistics. An exception from
// `frame` ends the loop and is rethrown unchanged. Throws core::Error if the library did not run
// the requested number of frames.
[[nodiscard]] BenchmarkResult time_frames(const std::string& name, int frames,
                                          const std::function<IterationTime()>& frame);

// Runs frames back to back. The library measures only the total wall time.
[[nodiscard]] BenchmarkResult time_loop(const std::string& name, int frames,
                                        const std::function<void()>& frame);

}  // namespace triptych::measure
