#include "measure/run/memory_growth.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/unit/measure_run/run_fixture.hpp"

namespace triptych::measure {
namespace {

using record::DeviceFaultKind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::uint64_t mib = std::uint64_t{1} << 20U;

Job job_named(const std::string& name) {
  return {.name = name, .configuration = {}, .protocol = {}, .faults = {}};
}

// Adds configurations with these peaks in MiB. Returns the number of configurations after which the
// growth is suspicious for the first time, or 0.
std::size_t first_suspicion(MemoryGrowth& growth, const std::vector<std::uint64_t>& peaks) {
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    if (growth.add(job_named(fmt::format("{}", i)), peaks[i] * mib)) return i + 1;
  }
  return 0;
}

std::vector<std::string> names(const std::vector<Job>& jobs) {
  std::vector<std::string> result;
  std::ranges::transform(jobs, std::back_inserter(result), &Job::name);
  return result;
}

// A leak of 24 MiB, in a run whose configurations differ.
TEST(MemoryGrowth, ALeakIsSuspiciousAfterAFullWindow) {
  MemoryGrowth growth;
  EXPECT_EQ(first_suspicion(growth, {100, 130, 154, 178, 202, 230, 254, 278, 302}), 9U);
}

TEST(MemoryGrowth, GrowthInFewConfigurationsIsNotSuspicious) {
  MemoryGrowth growth;
  EXPECT_EQ(first_suspicion(growth, {100, 400, 400, 700, 700, 700, 900, 900, 900, 900, 1000}), 0U);
}

// The window excludes early configurations, so a leak of one technique is found after others.
TEST(MemoryGrowth, ALateLeakIsSuspicious) {
  MemoryGrowth growth;
  std::vector<std::uint64_t> peaks(20, 100);
  for (std::uint64_t i = 1; i <= 8; ++i) peaks.push_back(100 + 24 * i);
  EXPECT_GT(first_suspicion(growth, peaks), 20U);
}

TEST(MemoryGrowth, ANewWorkerStartsAgain) {
  MemoryGrowth growth;
  EXPECT_EQ(first_suspicion(growth, {100, 130, 160, 190, 220}), 0U);
  growth.restart();
  EXPECT_EQ(first_suspicion(growth, {300, 330, 360, 390, 420}), 0U);
}

TEST(MemoryGrowth, RepeatsBeginAndEndWithTheSameConfiguration) {
  MemoryGrowth growth;
  ASSERT_EQ(first_suspicion(growth, {100, 130, 160, 190, 220, 250, 280, 310, 340}), 9U);
  const std::vector<Job> repeats = growth.repeats();
  EXPECT_THAT(names(repeats), ElementsAre("8", "1", "2", "3", "4", "5", "6", "7", "8"));
  EXPECT_TRUE(std::ranges::all_of(repeats, &Job::report_resident));
  EXPECT_TRUE(
      std::ranges::all_of(repeats, [](const Job& each) { return each.protocol.measure_every; }));
}

// lavapipe 25.0 for a plan of 20 configurations (five step sizes, two quadratures, two volumes).
// In three of five runs, the median growth was above the limit of a suspicion.
TEST(MemoryGrowth, GrowthThatDoesNotRecurIsNotALeak) {
  MemoryGrowth growth;
  ASSERT_EQ(first_suspicion(growth, {175, 201, 201, 220, 237, 256, 256, 273, 290}), 9U);
  const std::vector<std::uint64_t> resident{1503 * mib / 10, 1503 * mib / 10, 1505 * mib / 10,
                                            1505 * mib / 10, 1505 * mib / 10, 1505 * mib / 10,
                                            1505 * mib / 10, 1505 * mib / 10, 1510 * mib / 10};
  EXPECT_FALSE(growth.leak(resident));
}

TEST(MemoryGrowth, GrowthThatRecursIsALeak) {
  MemoryGrowth growth;
  std::vector<std::uint64_t> resident;
  for (std::uint64_t i = 0; i <= MemoryGrowth::window; ++i)
    resident.push_back((200 + 24 * i) * mib);
  EXPECT_EQ(growth.leak(resident), 24 * mib);
  std::ranges::reverse(resident);
  EXPECT_FALSE(growth.leak(resident));
}

TEST(MemoryGrowth, ADroppedSuspicionMakesTheNextOneLater) {
  MemoryGrowth growth;
  ASSERT_EQ(first_suspicion(growth, {0, 20, 40, 60, 80, 100, 120, 140, 160}), 9U);
  EXPECT_FALSE(growth.leak(std::vector<std::uint64_t>(9, 100 * mib)));
  std::vector<std::uint64_t> peaks;
  for (std::uint64_t i = 1; i <= 40; ++i) peaks.push_back(160 + 20 * i);
  EXPECT_EQ(first_suspicion(growth, peaks), 2 * MemoryGrowth::window);
}

class MemoryGrowthRun : public RunTest {
 protected:
  [[nodiscard]] std::vector<record::DeviceFault> faults_of(const std::string& script_text) {
    const Variable null_script("TRIPTYCH_NULL_SCRIPT", script_text);
    std::vector<std::string> cameras;
    for (int i = 1; i <= 10; ++i) cameras.push_back(fmt::format("random:{}", i));
    const RunResult result = run(plan(
        {{"technique", {"raycast"}}, {"data", {"cube"}}, {"step", {"0.5"}}, {"camera", cameras}}));
    EXPECT_EQ(result.measured, 10);
    EXPECT_EQ(records(result.run).size(), 10U);
    return open_store().devices(result.run).at(0).device.faults;
  }
};

// 17.5 MiB for each new configuration are suspicious, but are not needed again for the same work.
TEST_F(MemoryGrowthRun, CachesAreNotAFault) {
  EXPECT_THAT(faults_of(R"({"base_ns": 3e6, "caches": {"*width=8,*": 18350080}})"), IsEmpty());
}

TEST_F(MemoryGrowthRun, ALeakIsAFault) {
  const auto faults = faults_of(R"({"base_ns": 3e6, "leaks": {"*width=8,*": 18350080}})");
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults.front().kind, DeviceFaultKind::memory_grows);
  EXPECT_THAT(faults.front().detail, HasSubstr("17 MiB per configuration"));
}

}  // namespace
}  // namespace triptych::measure
