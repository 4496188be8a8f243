// Tests that the check `correlation`, which compares the costs of one device with those of another,
// finds injected slowdowns, and reports nothing else.

#include <gmock/gmock.h>

#include <map>

#include "report/exports/verdict_json.hpp"
#include "synthetic_run.hpp"

namespace triptych::judge {
namespace {

using testing::HasSubstr;

constexpr const char* lavapipe = "vulkan:lavapipe";
constexpr const char* llvmpipe = "gl:llvmpipe-egl";
constexpr const char* pocl = "opencl:pocl";
const std::string chosen = "camera=c1,data=d2,step=1,technique=t3";

// Returns the findings about a configuration or a level, without those about a device as a whole.
std::vector<Finding> specific_findings(const CorrelationFindings& result) {
  std::vector<Finding> findings;
  for (const Finding& finding : result.findings) {
    if (!finding.configuration.empty() || !finding.subject.empty()) findings.push_back(finding);
  }
  return findings;
}

std::size_t count(const CorrelationFindings& result, Verdict verdict) {
  return static_cast<std::size_t>(std::ranges::count(result.findings, verdict, &Finding::verdict));
}

TEST(AcceptedDevices, JitterWithinTheBoundsIsIgnored) {
  for (std::uint64_t trial = 0; trial < 300; ++trial) {
    SyntheticRun run(trial);
    for (const char* id : {lavapipe, llvmpipe, pocl}) run.add_device(id, true);
    const CorrelationFindings result = run.judge();
    ASSERT_EQ(count(result, Verdict::pass), 3U) << trial << '\n' << text(result);
    ASSERT_EQ(result.findings.size(), 3U) << trial << '\n' << text(result);
  }
}

// Shows that the previous test can fail: jitter beyond its bound must be reported.
TEST(AcceptedDevices, JitterBeyondTheBoundIsReported) {
  SyntheticRun run(1);
  run.add_device(lavapipe, true);
  run.add_device(llvmpipe, true, 0.02, {}, on_configuration(chosen, 1.01));
  EXPECT_EQ(specific_findings(run.judge()).size(), 1U) << text(run.judge());
}

TEST(AcceptedDevices, HalfAPercentOfOneConfigurationIsReportedFirst) {
  for (std::uint64_t trial = 0; trial < 34; ++trial) {
    for (const char* id : {lavapipe, llvmpipe, pocl}) {
      SyntheticRun run(trial);
      for (const char* each : {lavapipe, llvmpipe, pocl}) {
        // The injected slowdown is 0.5 % of the frame's cost, of which 70 % is device code.
        const auto injected =
            id == each ? on_configuration(chosen, 1 + 0.005 / 0.7) : SyntheticRun::Change{};
        run.add_device(each, true, 0.1, injected);
      }
      const CorrelationFindings result = run.judge();
      const auto found = specific_findings(result);
      ASSERT_EQ(found.size(), 1U) << text(result);
      EXPECT_EQ(found[0].verdict, Verdict::regression);
      EXPECT_EQ(found[0].device, id);
      EXPECT_EQ(found[0].configuration, chosen);
      EXPECT_NEAR(found[0].numbers.at("ratio"), 1.005, 1e-5);
      EXPECT_EQ(count(result, Verdict::pass), 2U) << text(result);
    }
  }
}

// The slowdown is 0.75 % of the frame's cost, and occurs only in the driver, which causes 30 % of
// the cost. The slowdown exceeds the sum of the two devices' bounds on driver jitter, so it is
// found.
TEST(AcceptedDevices, ASlowdownOfTheDriverIsFoundOnPocl) {
  SyntheticRun run(3);
  run.add_device(lavapipe, true);
  run.add_device(pocl, true, 0.02, {}, on_configuration(chosen, 1 + 0.0075 / 0.3));
  const auto found = specific_findings(run.judge());
  ASSERT_EQ(found.size(), 1U) << text(run.judge());
  EXPECT_EQ(found[0].device, pocl);
}

TEST(AcceptedDevices, AQuarterPercentOfALevelIsOneFinding) {
  for (std::uint64_t trial = 0; trial < 100; ++trial) {
    SyntheticRun run(trial);
    run.add_device(pocl, true, 0.1, on_level("data", "d2", 1 + 0.0025 / 0.7));
    run.add_device(lavapipe, true, 0.1);
    const CorrelationFindings result = run.judge();
    const auto found = specific_findings(result);
    ASSERT_EQ(found.size(), 1U) << text(result);
    EXPECT_EQ(found[0].device, pocl);
    EXPECT_EQ(found[0].subject, "data=d2");
    EXPECT_EQ(found[0].configuration, "");
    EXPECT_EQ(found[0].verdict, Verdict::regression);
  }
}

TEST(AcceptedDevices, AGeneralChangeIsReportedOnceBesideOutliers) {
  SyntheticRun run(5);
  const auto injected = [](const record::Record& r) {
    return r.configuration == chosen ? 1.2 : 1.02;
  };
  run.add_device(lavapipe, true, 0.02, injected);
  run.add_device(llvmpipe, true);
  const CorrelationFindings result = run.judge();
  const auto found = specific_findings(result);
  ASSERT_EQ(found.size(), 2U) << text(result);
  EXPECT_EQ(found[0].subject, "everything");
  EXPECT_EQ(found[0].number("configurations"), 96);
  EXPECT_NEAR(found[0].number("ratio"), 1.014, 5e-4);
  EXPECT_EQ(found[1].configuration, chosen);
}

TEST(AcceptedDevices, LessIsAnImprovement) {
  SyntheticRun run(6);
  run.add_device(lavapipe, true, 0.02, on_configuration(chosen, 0.9));
  run.add_device(llvmpipe, true);
  const auto found = specific_findings(run.judge());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].verdict, Verdict::improved);
}

// If a code change affects both devices equally, it does not change their residual, which is the
// logarithm of the ratio of their costs. The check `cost` finds it instead.
TEST(AcceptedDevices, EqualChangesLeaveTheResidualUnchanged) {
  SyntheticRun run(7);
  run.add_device(lavapipe, true, 0.02, {}, on_configuration(chosen, 1.5));
  run.add_device(llvmpipe, true, 0.02, {}, on_configuration(chosen, 1.5));
  EXPECT_TRUE(specific_findings(run.judge()).empty()) << text(run.judge());
}

// If a run measured only one device, this device is compared with the stored costs of the others.
TEST(AcceptedDevices, ASingleDeviceIsComparedWithStoredCosts) {
  SyntheticRun run(8);
  run.add_device(lavapipe, true, 0.02, on_configuration(chosen, 1.01));
  run.add_device(llvmpipe, true);
  run.input().devices.erase(llvmpipe);
  std::erase_if(run.input().records, [](const record::Record* r) { return r->device == llvmpipe; });
  const auto found = specific_findings(run.judge());
  ASSERT_EQ(found.size(), 1U) << text(run.judge());
  EXPECT_EQ(found[0].configuration, chosen);
}

TEST(AcceptedDevices, CountsByAnotherCounterAreNotCompared) {
  SyntheticRun run(9);
  run.add_device(lavapipe, true, 0.02, on_configuration(chosen, 1.01));
  run.add_device(llvmpipe, true);
  for (auto& [key, stored] : run.input().stored) stored.counted_by = "another emulator";
  const CorrelationFindings result = run.judge();
  EXPECT_EQ(count(result, Verdict::regression), 0U) << text(result);
  EXPECT_THAT(text(result), HasSubstr("no_partner"));
}

// The results of repeated trials, each with a new device whose 96 configurations scatter around a
// line.
struct Trials {
  int found = 0;
  int wrong = 0;
};

Trials run_trials(const SyntheticRun::Change& injected, const std::string& configuration,
                  const std::string& level, double scatter, std::uint64_t runs = 100) {
  Trials trials;
  for (std::uint64_t trial = 0; trial < runs; ++trial) {
    SyntheticRun run(1000 + trial);
    run.add_device(lavapipe, true, 0);
    run.add_device(llvmpipe, false, scatter, injected, injected);
    bool was_found = false;
    for (const Finding& finding : specific_findings(run.judge())) {
      EXPECT_EQ(finding.verdict, Verdict::advisory);
      const bool right = finding.configuration == configuration && finding.subject == level;
      was_found = was_found || right;
      if (!right) ++trials.wrong;
    }
    if (was_found) ++trials.found;
  }
  return trials;
}

// The false discovery rate permits one false report in 100 trials on average, so four would
// indicate a fault. If the scatter is normally distributed with a standard deviation of 2 %, a
// slowdown of 10 % is 4.8 standard deviations. To keep 99 % of the reports correct, 4 standard
// deviations are required. With a scatter of 1.5 %, almost all slowdowns are found.
TEST(NewDevice, TenPercentOfOneConfiguration) {
  const Trials wide = run_trials(on_configuration(chosen, 1.1), chosen, "", 0.02);
  EXPECT_GE(wide.found, 60);
  EXPECT_LE(wide.wrong, 3);
  const Trials narrow = run_trials(on_configuration(chosen, 1.1), chosen, "", 0.015);
  EXPECT_GE(narrow.found, 95);
  EXPECT_LE(narrow.wrong, 3);
}

TEST(NewDevice, ThreePercentOfALevel) {
  const Trials trials = run_trials(on_level("data", "d2", 1.03), "", "data=d2", 0.02);
  EXPECT_GE(trials.found, 95);
  EXPECT_LE(trials.wrong, 3);
}

// If 1 % of the trials have a false report, 5 are expected in 500 trials. An earlier experiment had
// 14 false reports in 1,500 trials.
TEST(NewDevice, NothingInjected) {
  const Trials trials = run_trials({}, "none", "none", 0.02, 500);
  EXPECT_LE(trials.wrong, 10);
}

TEST(NewDevice, UncorrelatedCostsAreRejected) {
  SyntheticRun run(10);
  run.add_device(lavapipe, true, 0);
  run.add_device(llvmpipe, false, 1);
  const CorrelationFindings result = run.judge();
  ASSERT_EQ(result.findings.size(), 2U) << text(result);
  EXPECT_THAT(text(result), HasSubstr("no_line"));
  EXPECT_TRUE(specific_findings(result).empty());
}

// If two devices were accepted, a line is fitted to the costs of the new device as a function of
// the costs of each accepted device. The new device is compared with the accepted device around
// whose line the costs scatter less.
TEST(NewDevice, IsComparedWithTheDeviceOfLeastScatter) {
  SyntheticRun run(11);
  run.add_device(lavapipe, true, 0.1);
  run.add_device(pocl, true, 0.01);
  run.add_device(llvmpipe, false, 0, on_configuration(chosen, 1.3));
  const auto found = specific_findings(run.judge());
  ASSERT_EQ(found.size(), 1U) << text(run.judge());
  EXPECT_EQ(found[0].cause, Cause::off_the_line);
  EXPECT_EQ(found[0].fact("other"), "opencl:pocl");
}

TEST(NewDevice, StoredCostsOfADeviceThatIsNotInTheRun) {
  SyntheticRun run(12);
  run.add_device(lavapipe, true, 0);
  run.add_device(llvmpipe, false, 0.01, on_configuration(chosen, 1.3));
  run.input().devices.erase(lavapipe);
  std::erase_if(run.input().records, [](const record::Record* r) { return r->device == lavapipe; });
  const CorrelationFindings result = run.judge();
  const auto found = specific_findings(result);
  ASSERT_EQ(found.size(), 1U) << text(result);
  EXPECT_EQ(found[0].configuration, chosen);
  ASSERT_EQ(result.pairs.size(), 1U);
  EXPECT_EQ(result.pairs[0].device_a, "vulkan:lavapipe (1)");
}

TEST(Pairs, ByCostAndByTimeWithTheirOutliers) {
  SyntheticRun run(13);
  run.with_times = true;
  run.add_device(lavapipe, true, 0.02, on_configuration(chosen, 1.1));
  run.add_device(llvmpipe, true);
  const CorrelationFindings result = run.judge();
  ASSERT_EQ(result.pairs.size(), 2U);
  EXPECT_EQ(result.pairs[0].signal, "cost");
  EXPECT_EQ(result.pairs[1].signal, "time");
  for (const CorrelationPair& pair : result.pairs) {
    EXPECT_EQ(pair.device_a, llvmpipe);
    EXPECT_EQ(pair.device_b, lavapipe);
    EXPECT_TRUE(pair.line.admitted()) << name_of(pair.line.refusal);
    EXPECT_NEAR(pair.line.slope, 1, 0.05);
    EXPECT_EQ(pair.points.size(), 96U);
  }
  for (const CorrelationPoint& point : result.pairs[0].points) {
    EXPECT_EQ(point.outlier, point.configuration == chosen) << point.configuration;
  }
  const core::Json json = report::to_json(result.pairs[0]);
  EXPECT_EQ(json.at("line").at("admitted"), true);
  EXPECT_EQ(json.at("points").size(), 96U);
}

TEST(Pairs, ADeviceWithoutCostIsOmitted) {
  SyntheticRun run(14);
  run.with_times = true;
  run.add_device(lavapipe, true);
  run.add_device(llvmpipe, true);
  for (const record::Record* record : run.input().records) {
    if (record->device == llvmpipe) const_cast<record::Record*>(record)->cost.clear();
  }
  const CorrelationFindings result = run.judge();
  EXPECT_THAT(text(result), HasSubstr("skipped gl:llvmpipe-egl  : not_reported"));
  EXPECT_EQ(result.pairs.size(), 1U)
      << "without a cost, only the times of the two devices can be compared";
}

}  // namespace
}  // namespace triptych::judge
