#pragma once
// Google Benchmark drives the timed loops. One benchmark at a time is registered, run and removed;
// nothing is printed. Its JSON entries are kept, so that tools for Google Benchmark can be used.

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace triptych::measure {

// Initializes the library and makes it independent of its environment variables (BENCHMARK_*).
// Cheap, and may be called repeatedly.
void initialize_benchmarks();

struct BenchmarkResult {
  double total_ns = 0;  // total time of all iterations and repetitions
  nlohmann::json
      entries;  // array: the repetitions, then mean, median, minimum, quartiles, maximum, …
};

// The result of one iteration: its time, and further values that become keys of its JSON entry.
struct IterationTime {
  double ns = 0;
  std::map<std::string, double> facts;
};

// Runs each frame as a repetition of its own. Its time is the one that `frame` returns
// (UseManualTime). The JSON contains every sample and the library's statistics of them. An
// exception from `frame` ends the loop and is passed on unchanged. Throws core::Error if the
// library did not run what was requested.
[[nodiscard]] BenchmarkResult time_frames(const std::string& name, int frames,
                                          const std::function<IterationTime()>& frame);

// Runs frames back to back. The library measures the wall time once for all of them.
[[nodiscard]] BenchmarkResult time_loop(const std::string& name, int frames,
                                        const std::function<void()>& frame);

}  // namespace triptych::measure
