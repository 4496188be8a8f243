#include "measure/protocol/benchmark_loop.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <map>
#include <stdexcept>

namespace triptych::measure {
namespace {

TEST(TimeFrames, KeepsOneEntryPerFrameAndTheirStatistics) {
  initialize_benchmarks();
  int n = 0;
  testing::internal::CaptureStdout();
  const BenchmarkResult result = time_frames("a/b", 4, [&] {
    return IterationTime{1000.0 * ++n, {{"wall_ns", n}}};
  });
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(n, 4);
  EXPECT_NEAR(result.total_ns, 10000, 1e-6);
  std::map<std::string, double> aggregates;
  int iterations = 0;
  for (const auto& entry : result.entries) {
    if (entry.at("run_type") == "iteration") {
      EXPECT_EQ(entry.at("repetition_index"), iterations++);
      EXPECT_EQ(entry.at("wall_ns"), iterations);
    } else {
      aggregates[entry.at("aggregate_name")] = entry.at("real_time");
    }
  }
  EXPECT_EQ(iterations, 4);
  EXPECT_NEAR(aggregates.at("min"), 1000, 1e-6);
  EXPECT_NEAR(aggregates.at("lower_quartile"), 1750, 1e-6);
  EXPECT_NEAR(aggregates.at("median"), 2500, 1e-6);
  EXPECT_NEAR(aggregates.at("max"), 4000, 1e-6);
}

TEST(TimeFrames, TimesOfZeroStillMakeValidJson) {
  initialize_benchmarks();
  const BenchmarkResult result = time_frames("zero", 3, [] { return IterationTime{0, {}}; });
  EXPECT_GE(result.entries.size(), 3U);
}

TEST(TimeFrames, AnExceptionEndsTheLoopAndTheNextRunIsNotAffected) {
  initialize_benchmarks();
  int calls = 0;
  EXPECT_THROW(static_cast<void>(time_frames("bad", 8,
                                             [&]() -> IterationTime {
                                               if (++calls == 3) throw std::out_of_range("x");
                                               return {};
                                             })),
               std::out_of_range);
  EXPECT_EQ(calls, 3);
  EXPECT_EQ(time_frames("good", 2,
                        [] {
                          return IterationTime{1, {}};
                        })
                .entries.at(0)
                .at("name"),
            "good/iterations:1/repeats:2/manual_time");
}

TEST(TimeLoop, MeasuresAllFramesTogether) {
  initialize_benchmarks();
  int calls = 0;
  const BenchmarkResult result = time_loop("loop", 50, [&] { ++calls; });
  EXPECT_EQ(calls, 50);
  EXPECT_GT(result.total_ns, 0);
  ASSERT_EQ(result.entries.size(), 1U);
  EXPECT_EQ(result.entries.at(0).at("iterations"), 50);
  EXPECT_NEAR(result.entries.at(0).at("real_time").get<double>() * 50, result.total_ns, 1e-3);
}

}  // namespace
}  // namespace triptych::measure
