// Whether the shipped correlation plans can tell what they are for.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ranges>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "judge/baselines/baselines.hpp"
#include "judge/correlation/model.hpp"
#include "judge/statistics/regression.hpp"
#include "judge/statistics/statistics.hpp"

namespace triptych::judge {
namespace {

struct Times {
  std::vector<std::set<std::string>> levels;  // "factor=level" of each configuration
  std::vector<double> log_times;
};

std::set<std::string> levels_of(std::string_view configuration) {
  std::set<std::string> levels;
  for (const auto& level : std::views::split(configuration, ',')) {
    levels.emplace(level.begin(), level.end());
  }
  return levels;
}

// Of the plan's configurations; what it held before is still stored of devices that were not
// accepted since.
Times times_of(const StoredDevice& device, const std::vector<std::string>& plan) {
  Times times;
  for (const auto& [configuration, runs] : device.timings) {
    if (std::ranges::find(plan, configuration) == plan.end()) continue;
    std::vector<double> logarithms;
    for (const StoredTiming& run : runs) logarithms.push_back(std::log(run.median_ns));
    times.levels.push_back(levels_of(configuration));
    times.log_times.push_back(median(logarithms));
  }
  return times;
}

// By how much a level's standard error is larger for not knowing the slope: the square root of the
// variance inflation factor, 1/(1 − r²), r between the level's indicator and ln t.
double inflation(const Times& times, const std::string& level) {
  std::vector<double> inside;
  for (const auto& levels : times.levels) inside.push_back(levels.contains(level) ? 1 : 0);
  const double r = pearson_r(times.log_times, inside);
  return 1 / std::sqrt(1 - r * r);
}

std::set<std::string> varied(const Times& times) {
  std::set<std::string> result;
  for (const auto& levels : times.levels) result.insert(levels.begin(), levels.end());
  std::erase_if(result, [&](const std::string& level) {
    return std::ranges::all_of(times.levels, [&](const auto& all) { return all.contains(level); });
  });
  return result;
}

class CorrelationPlan : public testing::TestWithParam<std::string> {};

// A level that holds the long times, as a viewport of six times the pixels did, is told from a
// steeper line only by what the times within it differ by: its error was 2.2 to 3.3 times that of
// other levels, and a twentieth of it went unseen (docs/correlation.md, "A plan for it"). Twice the
// error takes four times the runs.
TEST_P(CorrelationPlan, HidesNoLevelInTheSlope) {
  const Baselines baselines(std::filesystem::path(TRIPTYCH_SOURCE_FOLDER) / "baselines",
                            GetParam());
  std::size_t devices = 0;
  for (const StoredDevice& device : baselines.timings_of_all_devices()) {
    const Times times = times_of(device, baselines.configurations());
    if (times.levels.size() < CorrelationModel::least_configurations) continue;
    ++devices;
    for (const std::string& level : varied(times)) {
      EXPECT_LT(inflation(times, level), 2) << level << " on " << device.key;
    }
  }
  EXPECT_GE(devices, 3U);
}

INSTANTIATE_TEST_SUITE_P(Shipped, CorrelationPlan,
                         testing::Values("volume/correlation", "particles/correlation"),
                         [](const auto& tested) {
                           return tested.param.substr(0, tested.param.find('/'));
                         });

}  // namespace
}  // namespace triptych::judge
