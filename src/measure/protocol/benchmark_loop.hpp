#pragma once
// Google Benchmark as the driver of timed loops: one benchmark is registered, run and forgotten at
// a time; nothing is printed. Its own JSON entries are kept, so that tools made for them can be
// used.

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace triptych::measure {

// Makes the library ready and takes from it every choice that its environment variables
// (BENCHMARK_*) could make for it. Cheap, and harmless when called again.
void initialize_benchmarks();

struct BenchmarkResult {
  double total_ns = 0;  // of all iterations and repetitions together
  nlohmann::json
      entries;  // array: the repetitions, then mean, median, minimum, quartiles, maximum, …
};

// What one iteration says of itself: the time that counts, and facts kept as flat keys of its
// entry.
struct IterationTime {
  double ns = 0;
  std::map<std::string, double> facts;
};

// Each frame as a repetition of its own with the time it reports (UseManualTime): the JSON holds
// every sample, and the statistics the library makes of them. An exception from `frame` ends the
// loop and comes out as it was. Throws core::Error when the library did not run what it was told
// to.
[[nodiscard]] BenchmarkResult time_frames(const std::string& name, int frames,
                                          const std::function<IterationTime()>& frame);

// Frames back to back, the wall time taken once around all of them by the library itself.
[[nodiscard]] BenchmarkResult time_loop(const std::string& name, int frames,
                                        const std::function<void()>& frame);

}  // namespace triptych::measure
