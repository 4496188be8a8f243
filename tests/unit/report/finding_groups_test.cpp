#include "report/finding_groups.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "findings.hpp"

namespace triptych::report {
namespace {

using judge::Check;
using judge::Finding;
using testing::ElementsAre;
using enum judge::Verdict;

TEST(FindingGroups, OneCauseIsReportedOnceWithTheSmallestCase) {
  const std::vector<Finding> findings{
      finding(regression, "gl:x", "data=generate:ball:64,technique=raycast,viewport=128",
              over_bound(9)),
      finding(regression, "gl:x", "data=generate:ball:64,technique=raycast,viewport=64",
              over_bound(3)),
      finding(pass, "gl:x", "data=generate:ball:64,technique=slices,viewport=64", within_bound()),
      finding(pass, "gl:y", "data=generate:ball:64,technique=raycast,viewport=64", within_bound())};
  const std::vector<FindingGroup> groups = grouped(findings);
  ASSERT_EQ(groups.size(), 3U);
  EXPECT_EQ(groups[0].configurations, 2U);
  EXPECT_EQ(groups[0].first, &findings[1]);
  EXPECT_EQ(groups[0].signature, "technique=raycast");
  EXPECT_THAT(groups[0].correct_devices, ElementsAre("gl:y"));
}

TEST(FindingGroups, OtherDevicesShowWhoIsAtFault) {
  const auto attribution = [](std::vector<Finding> findings) {
    return grouped(findings)[0].attribution();
  };
  Finding wrong = finding(regression, "vulkan:new", "technique=a");
  EXPECT_EQ(attribution({wrong}).kind, FaultAttribution::Kind::unknown);
  const Finding right = finding(pass, "vulkan:old", "technique=a", within_bound());
  EXPECT_EQ(attribution({wrong, right}).kind, FaultAttribution::Kind::driver);
  EXPECT_THAT(attribution({wrong, right}).devices, ElementsAre("vulkan:old"));
  EXPECT_EQ(attribution({wrong, finding(pass, "gl:old", "technique=a", within_bound())}).kind,
            FaultAttribution::Kind::unknown)
      << "Triptych's code for the API may be wrong";
  wrong.accepted_on = {"gl:old", "vulkan:new", "vulkan:old"};
  EXPECT_EQ(attribution({wrong}).kind, FaultAttribution::Kind::driver_since_accepted);
  EXPECT_THAT(attribution({wrong}).devices, ElementsAre("vulkan:old"))
      << "a device is not a witness against itself";
  Finding newer = wrong;
  newer.accepted_on = {"gl:old", "vulkan:new"};
  EXPECT_EQ(attribution({newer}).kind, FaultAttribution::Kind::driver_version);
  EXPECT_THAT(attribution({newer}).devices, ElementsAre());
  EXPECT_EQ(attribution({wrong, finding(regression, "opencl:x", "technique=a")}).kind,
            FaultAttribution::Kind::not_the_driver);
  wrong.injected = {"half_voxel"};
  EXPECT_EQ(attribution({wrong, right}).kind, FaultAttribution::Kind::unknown);
  EXPECT_EQ(attribution({finding(regression, "vulkan:lavapipe", "technique=a"),
                         finding(regression, "gl:llvmpipe-egl", "technique=a")})
                .kind,
            FaultAttribution::Kind::unknown)
      << "both APIs use the same driver";
  const Finding more = finding(regression, "vulkan:new", "technique=a", costlier, Check::cost);
  EXPECT_EQ(attribution({more, finding(pass, "vulkan:old", "technique=a", {}, Check::cost)}).kind,
            FaultAttribution::Kind::unknown);
}

// Configurations that were skipped because two similar ones had failed belong to the cause of those
// failures. The command must reproduce a configuration that was actually tried.
TEST(FindingGroups, UntriedConfigurationsCountTowardsTheirCause) {
  judge::Observation not_tried = crashed(11);
  not_tried.reason.not_tried = true;
  const std::vector<Finding> findings{
      finding(regression, "gl:x", "step=1,viewport=16", not_tried),
      finding(regression, "gl:x", "step=1,viewport=64", crashed(11))};
  const std::vector<FindingGroup> groups = grouped(findings);
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_EQ(groups[0].configurations, 2U);
  EXPECT_EQ(groups[0].first, &findings[1]);
}

TEST(FindingGroups, MoreCodeAndMoreMissesAreOneCause) {
  judge::Observation with_misses = costlier;
  with_misses.changes.push_back({"misses", judge::Unit::misses, 1, 2, {}, 0});
  const std::vector<Finding> findings{
      finding(regression, "gl:x", "step=1", costlier, Check::cost),
      finding(regression, "gl:x", "step=2", with_misses, Check::cost)};
  EXPECT_EQ(grouped(findings).size(), 1U);
}

TEST(FindingGroups, TechniquesAreSeparateCausesUnlessAllFailAlike) {
  std::vector<Finding> findings{finding(regression, "gl:x", "technique=a"),
                                finding(regression, "gl:x", "technique=b")};
  EXPECT_EQ(grouped(findings).size(), 1U);
  EXPECT_EQ(grouped(findings)[0].signature, "");
  findings.push_back(finding(pass, "gl:x", "technique=c"));
  ASSERT_EQ(grouped(findings).size(), 3U);
  EXPECT_EQ(grouped(findings)[1].signature, "technique=b");
}

TEST(FindingGroups, ThreeTechniquesThatFailAlikeHaveOneCause) {
  const std::vector<Finding> findings{finding(regression, "gl:x", "technique=a"),
                                      finding(regression, "gl:x", "technique=b"),
                                      finding(regression, "gl:x", "technique=c"),
                                      finding(pass, "gl:x", "technique=d", within_bound())};
  const std::vector<FindingGroup> groups = grouped(findings);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].configurations, 3U);
  EXPECT_EQ(groups[0].signature, "technique≠d");
  const std::vector<Finding> elsewhere{finding(regression, "gl:x", "technique=c,step=1"),
                                       finding(pass, "gl:x", "technique=a,step=1", within_bound())};
  EXPECT_TRUE(have_same_cause(groups[0], grouped(elsewhere)[0]));
  const std::vector<Finding> other{finding(regression, "gl:x", "technique=e"),
                                   finding(pass, "gl:x", "technique=a", within_bound())};
  EXPECT_FALSE(have_same_cause(groups[0], grouped(other)[0]));
}

TEST(FindingGroups, DevicesChecksVerdictsAndCausesAreSeparate) {
  const std::vector<Finding> findings{
      finding(regression, "gl:x", "step=1"), finding(regression, "gl:y", "step=1"),
      finding(cannot_judge, "gl:x", "step=2"),
      finding(regression, "gl:x", "step=2", changed("samples"), Check::counters),
      finding(regression, "gl:x", "step=3", judge::Observation{.cause = judge::Cause::not_finite})};
  EXPECT_EQ(grouped(findings).size(), 5U);
}

// An edited shader is compiled for every GPU family. Although different statistics change on
// different families, these changes have the same cause.
TEST(FindingGroups, ChangedCodeIsOneCauseOnAllDevices) {
  const std::vector<Finding> findings{
      finding(regression, "vulkan:a", "technique=x,viewport=64", changed("instructions"),
              Check::code),
      finding(regression, "vulkan:b", "technique=x,viewport=64", changed("latency"), Check::code),
      finding(regression, "gl:c", "technique=x,viewport=32", changed("latency"), Check::code),
      finding(pass, "opencl:d", "technique=x,viewport=32", {}, Check::code),
      finding(regression, "gl:e", "technique=x,viewport=32",
              judge::Observation{.cause = judge::Cause::not_finite}, Check::code)};
  const std::vector<FindingGroup> groups = grouped(findings);
  ASSERT_EQ(groups.size(), 3U);
  EXPECT_THAT(groups[0].devices, ElementsAre("gl:c", "vulkan:a", "vulkan:b"));
  EXPECT_EQ(groups[0].configurations, 2U);
  EXPECT_EQ(groups[0].first, &findings[2]);
  EXPECT_THAT(groups[0].correct_devices, ElementsAre("opencl:d"));
  EXPECT_THAT(groups[1].devices, ElementsAre("gl:e"));
}

TEST(FindingGroups, FaultsOfADeviceAreSeparate) {
  const auto fault = [](const std::string& kind) {
    return judge::Observation{.cause = judge::Cause::device_fault, .facts = {{"kind", kind}}};
  };
  const std::vector<Finding> findings{finding(regression, "gl:x", "", fault("clock_reads_zero")),
                                      finding(regression, "gl:x", "", fault("teardown_crash"))};
  EXPECT_EQ(grouped(findings).size(), 2U);
}

TEST(FindingGroups, CountersOfAWrongImageAreReportedWithIt) {
  const std::vector<Finding> findings{
      finding(regression, "gl:x", "step=1"), finding(regression, "gl:x", "step=2"),
      finding(regression, "gl:x", "step=2", changed("samples"), Check::counters),
      finding(regression, "gl:y", "step=2", changed("samples"), Check::counters)};
  const std::vector<FindingGroup> groups = grouped(findings);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].changed_counters, 1U);
  EXPECT_EQ(groups[1].first, &findings[3]);
}

TEST(FindingGroups, WorstFirstAndCausesBeforeConsequences) {
  const std::vector<Finding> findings{
      finding(advisory, "gl:x", "step=1"),
      finding(cannot_judge, "gl:x", "step=1"),
      finding(regression, "gl:x", "step=1", changed("samples"), Check::counters),
      finding(regression, "gl:x", "step=2", crashed(11), Check::counters),
      finding(regression, "gl:y", "step=1"),
      finding(regression, "gl:x", "step=4"),
      finding(regression, "gl:x", "step=5")};
  std::vector<std::string> order;
  for (const FindingGroup& group : grouped(findings)) {
    order.push_back(fmt::format("{} {}", group.first->device, judge::name_of(group.first->cause)));
  }
  EXPECT_THAT(order, ElementsAre("gl:x ended", "gl:x pixels_over_bound", "gl:y pixels_over_bound",
                                 "gl:x values_changed", "gl:x pixels_over_bound",
                                 "gl:x pixels_over_bound"));
}

TEST(FindingGroups, CorrelationFindingsAreOmittedIfTheCostExplainsThem) {
  std::vector<Finding> findings{
      finding(regression, "gl:x", "step=1", costlier, Check::cost),
      finding(regression, "gl:x", "step=1", off_the_line, Check::correlation),
      finding(regression, "gl:x", "", off_the_line, Check::correlation)};
  ASSERT_EQ(grouped(findings).size(), 1U);
  EXPECT_EQ(grouped(findings)[0].first, findings.data());
  findings.push_back(finding(regression, "gl:x", "step=2", off_the_line, Check::correlation));
  findings.push_back(finding(regression, "gl:y", "", off_the_line, Check::correlation));
  EXPECT_EQ(grouped(findings).size(), 3U);
}

}  // namespace
}  // namespace triptych::report
