#include "judge/statistics/drift.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "core/random.hpp"

namespace triptych::judge {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

class Noise {
 public:
  explicit Noise(std::uint64_t seed) : random_(seed) {}
  // Nearly normal, standard deviation 1 %.
  double operator()() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += random_.uniform();
    return 0.01 * sum;
  }

 private:
  core::Random random_;
};

std::vector<double> steady(Noise& noise, std::size_t runs) {
  std::vector<double> series(runs);
  for (double& each : series) each = noise();
  return series;
}

TEST(Drift, AStepIsFoundWhereItIs) {
  Noise noise(1);
  std::vector<double> series = steady(noise, 20);
  for (std::size_t i = 12; i < series.size(); ++i) series[i] += 0.05;
  const auto change = change_point(series);
  ASSERT_TRUE(change);
  EXPECT_EQ(change->at, 12U);
  EXPECT_NEAR(change->effect, 0.05, 0.01);
  EXPECT_LT(change->p, 0.001);
}

// Five runs, then five slower ones: no other order of ten ranks but the reverse splits so far, so
// that p is 2·5!·5!/10! = 0.0079.
TEST(Drift, TheSmallestPOfTenRunsIsKnown) {
  const auto change = change_point(std::vector<double>{1, 3, 2, 5, 4, 8, 6, 7, 10, 9});
  ASSERT_TRUE(change);
  EXPECT_EQ(change->at, 5U);
  EXPECT_EQ(change->effect, 5);
  EXPECT_NEAR(change->p, 0.0079, 0.003);
}

TEST(Drift, PIsUniformWithoutAStep) {
  Noise noise(2);
  int small = 0;
  constexpr int trials = 300;
  for (int i = 0; i < trials; ++i) small += change_point(steady(noise, 12))->p <= 0.1 ? 1 : 0;
  // Binomial with 0.1: 30 ± 5.2; the rank sums are discrete, so a little fewer.
  EXPECT_GT(small, 10);
  EXPECT_LT(small, 47);
}

TEST(Drift, OneWildRunIsNoStep) {
  Noise noise(3);
  std::vector<double> series = steady(noise, 20);
  series[13] += 3;
  EXPECT_GT(change_point(series)->p, 0.05);
}

TEST(Drift, FewRunsSayNothing) {
  EXPECT_FALSE(change_point(std::vector<double>(DriftModel::least_runs - 1, 0.0)));
  EXPECT_EQ(change_point(std::vector<double>(DriftModel::least_runs, 0.0))->p, 1);
}

// A tenth in steps of a twentieth of it, none of which a gate against the mean would call slower.
std::vector<DriftSeries> family(double whole, double of_one) {
  Noise noise(4);
  std::vector<DriftSeries> series;
  for (int i = 0; i < 12; ++i) {
    series.push_back({.device = "a", .log_times = steady(noise, 20)});
    for (std::size_t run = 0; run < 20; ++run) {
      const double share = static_cast<double>(run) / 19;
      series.back().log_times[run] += share * (whole + (i == 7 ? of_one : 0));
    }
  }
  return series;
}

TEST(Drift, OfOneConfigurationIsItsOwn) {
  const auto found = find_drift(family(0, 0.1));
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].series, 7U);
  EXPECT_GT(found[0].change.effect, std::log(DriftModel::least_effect));
}

TEST(Drift, OneOfAThousandIsFound) {
  auto series = family(0, 0);
  core::Random random(5);
  while (series.size() < 1200) {
    DriftSeries& added = series.emplace_back(series.front());
    for (double& value : added.log_times) value = 14 + 0.02 * random.uniform(-1, 1);
  }
  for (std::size_t run = 10; run < 20; ++run) series[700].log_times[run] += 0.5;
  const auto found = find_drift(series);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].series, 700U);
}

TEST(Drift, OfAllIsTheDevices) {
  const auto found = find_drift(family(0.1, 0));
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_FALSE(found[0].series);
  EXPECT_EQ(found[0].device, "a");
}

TEST(Drift, FasterSmallOrNoneIsNotTold) {
  EXPECT_THAT(find_drift(family(0, 0)), IsEmpty());
  EXPECT_THAT(find_drift(family(-0.1, 0)), IsEmpty());
  EXPECT_THAT(find_drift(family(0.02, 0)), IsEmpty());
}

TEST(Drift, RunsThatASeriesLacksAreCounted) {
  auto series = family(0, 0);
  for (std::size_t run = 0; run < 20; ++run) series[3].log_times[run] += run < 12 ? 0 : 0.2;
  series[3].log_times[5] = std::numeric_limits<double>::quiet_NaN();
  const auto found = find_drift(series);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].series, 3U);
  EXPECT_EQ(found[0].change.at, 12U);
}

}  // namespace
}  // namespace triptych::judge
