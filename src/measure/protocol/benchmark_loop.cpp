#include "measure/protocol/benchmark_loop.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <sstream>
#include <vector>

#include "core/error.hpp"
#include "record/record.hpp"

namespace triptych::measure {
namespace {

// Collects the JSON output of Google Benchmark in a string. Removes numbers that JSON cannot
// represent, such as the coefficient of variation of times that are all 0, because Google Benchmark
// would print them as invalid JSON.
class StringReporter : public benchmark::JSONReporter {
 public:
  StringReporter() {
    SetOutputStream(&text_);
    SetErrorStream(&errors_);
  }

  void ReportRuns(const std::vector<Run>& runs) override {
    std::vector<Run> printable;
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Iteration) {
        total_ns_ += run.real_accumulated_time * 1e9;
        executed_ += run.iterations;
      }
      if (!std::isfinite(run.real_accumulated_time) || !std::isfinite(run.cpu_accumulated_time)) {
        continue;
      }
      printable.push_back(run);
      std::erase_if(printable.back().counters,
                    [](const auto& counter) { return !std::isfinite(counter.second.value); });
    }
    if (!printable.empty()) JSONReporter::ReportRuns(printable);
  }

  [[nodiscard]] double total_ns() const { return total_ns_; }
  [[nodiscard]] benchmark::IterationCount executed() const { return executed_; }
  [[nodiscard]] std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  std::ostringstream errors_;
  double total_ns_ = 0;
  benchmark::IterationCount executed_ = 0;
};

// Unregisters the benchmark at the end of the scope, even after an exception.
class Registration {
 public:
  Registration() = default;
  Registration(const Registration&) = delete;
  Registration& operator=(const Registration&) = delete;
  ~Registration() { benchmark::ClearRegisteredBenchmarks(); }
};

BenchmarkResult run_registered(const std::string& name, int frames) {
  StringReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter, "all");
  if (reporter.executed() != frames) {
    throw core::Error(fmt::format("Google Benchmark ran {} instead of {} frames of {}",
                                  reporter.executed(), frames, name));
  }
  return {.total_ns = reporter.total_ns(),
          .entries = nlohmann::json::parse(reporter.text()).at("benchmarks")};
}

// Stores the first exception, so that it can be rethrown after the loop. The remaining iterations
// do nothing. This is necessary because Google Benchmark does not handle exceptions, and aborts if
// one of several repetitions reports an error.
class ExceptionGuard {
 public:
  template <typename Body>
  void operator()(const Body& body) {
    if (failure_) return;
    try {
      body();
    } catch (...) {
      failure_ = std::current_exception();
    }
  }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::exception_ptr failure_;
};

double minimum(const std::vector<double>& values) {
  return record::percentile(values, 0);
}
double lower_quartile(const std::vector<double>& values) {
  return record::percentile(values, 0.25);
}
double upper_quartile(const std::vector<double>& values) {
  return record::percentile(values, 0.75);
}
double maximum(const std::vector<double>& values) {
  return record::percentile(values, 1);
}

}  // namespace

void initialize_benchmarks() {
  // These options override the environment variables BENCHMARK_*.
  std::array<std::string, 11> words{"triptych",
                                    "--benchmark_filter=all",
                                    "--benchmark_list_tests=false",
                                    "--benchmark_repetitions=1",
                                    "--benchmark_time_unit=ns",
                                    "--benchmark_out=",
                                    "--benchmark_report_aggregates_only=false",
                                    "--benchmark_display_aggregates_only=false",
                                    "--benchmark_enable_random_interleaving=false",
                                    "--benchmark_min_warmup_time=0",
                                    "--benchmark_perf_counters="};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data());
  // Google Benchmark has stored a pointer to the program's name in `words`, which is about to be
  // destroyed.
  benchmark::BenchmarkReporter::Context::executable_name = "triptych";
}

BenchmarkResult time_frames(const std::string& name, int frames,
                            const std::function<IterationTime()>& frame) {
  const Registration registration;
  ExceptionGuard guard;
  benchmark::RegisterBenchmark(name.c_str(),
                               [&](benchmark::State& state) {
                                 for (auto _ : state) {
                                   IterationTime time;
                                   guard([&] { time = frame(); });
                                   state.SetIterationTime(time.ns * 1e-9);
                                   for (const auto& [fact, value] : time.facts) {
                                     state.counters[fact] = value;
                                   }
                                 }
                               })
      ->UseManualTime()
      ->Iterations(1)
      ->Repetitions(frames)
      ->ComputeStatistics("min", minimum)
      ->ComputeStatistics("lower_quartile", lower_quartile)
      ->ComputeStatistics("upper_quartile", upper_quartile)
      ->ComputeStatistics("max", maximum);
  BenchmarkResult result = run_registered(name, frames);
  guard.rethrow();
  return result;
}

BenchmarkResult time_loop(const std::string& name, int frames, const std::function<void()>& frame) {
  const Registration registration;
  ExceptionGuard guard;
  benchmark::RegisterBenchmark(name.c_str(),
                               [&](benchmark::State& state) {
                                 for (auto _ : state) guard(frame);
                               })
      ->UseRealTime()
      ->Iterations(frames);
  BenchmarkResult result = run_registered(name, frames);
  guard.rethrow();
  return result;
}

}  // namespace triptych::measure
