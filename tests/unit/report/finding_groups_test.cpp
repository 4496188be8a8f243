#include "report/finding_groups.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "support/well_formed.hpp"

namespace triptych::report {
namespace {

using judge::Check;
using judge::Finding;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using enum judge::Verdict;

Finding finding(judge::Verdict verdict, const std::string& device, const std::string& configuration,
                const std::string& message = "3 of 64 pixels are over the bound",
                Check check = Check::image) {
  return {.check = check,
          .verdict = verdict,
          .test = fmt::format("volume.quick.{}.{}", judge::name_of(check), device),
          .device = device,
          .configuration = configuration,
          .message = message};
}

TEST(FindingGroups, OneCauseIsSaidOnceWithTheSmallestCase) {
  const std::vector<Finding> findings{
      finding(regression, "gl:x", "data=generate:ball:64,technique=raycast,viewport=128",
              "9 of 16384 pixels are over the bound"),
      finding(regression, "gl:x", "data=generate:ball:64,technique=raycast,viewport=64",
              "3 of 4096 pixels are over the bound"),
      finding(pass, "gl:x", "data=generate:ball:64,technique=slices,viewport=64", "within"),
      finding(pass, "gl:y", "data=generate:ball:64,technique=raycast,viewport=64", "within")};
  const std::vector<FindingGroup> groups = grouped(findings);
  ASSERT_EQ(groups.size(), 3U);
  EXPECT_EQ(groups[0].configurations, 2U);
  EXPECT_EQ(groups[0].first, &findings[1]);
  EXPECT_EQ(groups[0].signature, "technique=raycast");
  EXPECT_THAT(groups[0].right_on, ElementsAre("gl:y"));
  EXPECT_EQ(groups[0].subject(), "2 configurations");
}

TEST(FindingGroups, WhoseItIsByWhatOtherDevicesDo) {
  const auto whose = [](std::vector<Finding> findings) { return grouped(findings)[0].whose(); };
  Finding wrong = finding(regression, "vulkan:new", "technique=a");
  EXPECT_EQ(whose({wrong}), "");
  const Finding right = finding(pass, "vulkan:old", "technique=a", "within");
  EXPECT_EQ(whose({wrong, right}), "the driver's: vulkan:old is right by the same API");
  EXPECT_EQ(whose({wrong, finding(pass, "gl:old", "technique=a", "within")}), "")
      << "our code for the API may be wrong";
  wrong.accepted_on = {"gl:old", "vulkan:new", "vulkan:old"};
  EXPECT_EQ(whose({wrong}),
            "the driver's: vulkan:new of another version, vulkan:old were right by the same API");
  EXPECT_EQ(whose({wrong, finding(regression, "opencl:x", "technique=a")}),
            "not the driver's: vulkan:new is wrong, too");
  wrong.injected = {"half_voxel"};
  EXPECT_EQ(whose({wrong, right}), "");
  EXPECT_EQ(whose({finding(regression, "vulkan:lavapipe", "technique=a"),
                   finding(regression, "gl:llvmpipe-egl", "technique=a")}),
            "")
      << "one driver behind two interfaces";
  const Finding dearer = finding(regression, "vulkan:new", "technique=a", "more", Check::cost);
  EXPECT_EQ(whose({dearer, finding(pass, "vulkan:old", "technique=a", "", Check::cost)}), "");
}

// What two shown failures foretell is counted with them, and one that was tried is told.
TEST(FindingGroups, WhatWasNotTriedIsOfTheCauseThatWas) {
  const std::vector<Finding> findings{
      finding(regression, "gl:x", "step=1,viewport=16",
              "crashed: SIGSEGV; not tried, as others ended so with technique=raycast"),
      finding(regression, "gl:x", "step=1,viewport=64", "crashed: SIGSEGV")};
  const std::vector<FindingGroup> groups = grouped(findings);
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_EQ(groups[0].configurations, 2U);
  EXPECT_EQ(groups[0].first, &findings[1]);
}

TEST(FindingGroups, MoreCodeAndMoreMissesAreOneCause) {
  const std::vector<Finding> findings{
      finding(regression, "gl:x", "step=1", "instructions 3 → 4 in all; code 1 → 2", Check::cost),
      finding(regression, "gl:x", "step=2",
              "instructions 5 → 6 in all; code 3 → 4; cache misses of code 1 → 2", Check::cost)};
  EXPECT_EQ(grouped(findings).size(), 1U);
}

TEST(FindingGroups, TechniquesAreCausesOfTheirOwnUnlessAllSayIt) {
  std::vector<Finding> findings{finding(regression, "gl:x", "technique=a"),
                                finding(regression, "gl:x", "technique=b")};
  EXPECT_EQ(grouped(findings).size(), 1U);
  EXPECT_EQ(grouped(findings)[0].signature, "");
  findings.push_back(finding(pass, "gl:x", "technique=c"));
  ASSERT_EQ(grouped(findings).size(), 3U);
  EXPECT_EQ(grouped(findings)[1].signature, "technique=b");
}

TEST(FindingGroups, ThreeTechniquesThatSayTheSameHaveOneCause) {
  const std::vector<Finding> findings{
      finding(regression, "gl:x", "technique=a"), finding(regression, "gl:x", "technique=b"),
      finding(regression, "gl:x", "technique=c"), finding(pass, "gl:x", "technique=d", "within")};
  const std::vector<FindingGroup> groups = grouped(findings);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].configurations, 3U);
  EXPECT_EQ(groups[0].signature, "technique≠d");
  const std::vector<Finding> elsewhere{finding(regression, "gl:x", "technique=c,step=1"),
                                       finding(pass, "gl:x", "technique=a,step=1", "within")};
  EXPECT_TRUE(have_one_cause(groups[0], grouped(elsewhere)[0]));
  const std::vector<Finding> other{finding(regression, "gl:x", "technique=e"),
                                   finding(pass, "gl:x", "technique=a", "within")};
  EXPECT_FALSE(have_one_cause(groups[0], grouped(other)[0]));
}

TEST(FindingGroups, DevicesChecksVerdictsAndMessagesAreCausesOfTheirOwn) {
  const std::vector<Finding> findings{
      finding(regression, "gl:x", "step=1"), finding(regression, "gl:y", "step=1"),
      finding(cannot_judge, "gl:x", "step=2"),
      finding(regression, "gl:x", "step=2", "samples 3 → 4", Check::counters),
      finding(regression, "gl:x", "step=3", "4 of 64 pixels are not finite")};
  EXPECT_EQ(grouped(findings).size(), 5U);
}

TEST(FindingGroups, AWrongPicturesCountersAreToldWithIt) {
  const std::vector<Finding> findings{
      finding(regression, "gl:x", "step=1"), finding(regression, "gl:x", "step=2"),
      finding(regression, "gl:x", "step=2", "samples 3 → 4", Check::counters),
      finding(regression, "gl:y", "step=2", "samples 3 → 4", Check::counters)};
  const std::vector<FindingGroup> groups = grouped(findings);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].changed_with_it, 1U);
  EXPECT_EQ(groups[1].first, &findings[3]);
}

TEST(FindingGroups, WorstFirstAndCausesBeforeConsequences) {
  const std::vector<Finding> findings{
      finding(advisory, "gl:x", "step=1"),
      finding(cannot_judge, "gl:x", "step=1"),
      finding(regression, "gl:x", "step=1", "samples 3 → 4", Check::counters),
      finding(regression, "gl:x", "step=2", "crashed: signal 11", Check::counters),
      finding(regression, "gl:y", "step=1"),
      finding(regression, "gl:x", "step=4"),
      finding(regression, "gl:x", "step=5")};
  std::vector<std::string> order;
  for (const FindingGroup& group : grouped(findings)) {
    order.push_back(
        fmt::format("{} {}", group.first->device,
                    group.first->message.substr(0, group.first->message.find(" pixels"))));
  }
  EXPECT_THAT(order, ElementsAre("gl:x crashed: signal 11", "gl:x 3 of 64", "gl:y 3 of 64",
                                 "gl:x samples 3 → 4", "gl:x 3 of 64", "gl:x 3 of 64"));
}

TEST(FindingGroups, ADeviceOffTheLineIsNotToldWhereItsCostTellsWhy) {
  std::vector<Finding> findings{
      finding(regression, "gl:x", "step=1", "instructions 1 → 2", Check::cost),
      finding(regression, "gl:x", "step=1", "off the residuals", Check::correlation),
      finding(regression, "gl:x", "", "everything is off", Check::correlation)};
  ASSERT_EQ(grouped(findings).size(), 1U);
  EXPECT_EQ(grouped(findings)[0].first, findings.data());
  findings.push_back(
      finding(regression, "gl:x", "step=2", "off the residuals", Check::correlation));
  findings.push_back(finding(regression, "gl:y", "", "everything is off", Check::correlation));
  EXPECT_EQ(grouped(findings).size(), 3U);
}

TEST(CommandOf, DrawsTheConfigurationAgain) {
  const Finding wrong = finding(regression, "gl:x#2", "data=a b%2Cc,step=0.5");
  judge::GateResult quick{.plan = "volume/quick", .run = "r", .findings = {}};
  quick.environments = {{"gl:x#2", {{"LP_X", "$(x)"}}}};
  EXPECT_EQ(command_of(wrong, quick),
            "LP_X='$(x)' triptych render volume --device 'gl:x#2' --set 'data=a b%2Cc' --set "
            "step=0.5 --truth --out repro");
  Finding injected = wrong;
  injected.injected = {"coarse_filter"};
  EXPECT_THAT(command_of(injected, quick), HasSubstr(" --inject coarse_filter --truth --out"));
  Finding hung =
      finding(regression, "gl:x", "step=1", "hung: no answer within 2 s; it last said: x");
  EXPECT_THAT(command_of(hung, quick), HasSubstr(" --limit 2 --truth --out"));
  hung.message = "hung: no answer within 60 s";  // as long as `render` waits anyway
  EXPECT_THAT(command_of(hung, quick), Not(HasSubstr("--limit")));
}

// Of what is stored, a command has to judge by it: of one configuration of the plan as it was
// typed.
TEST(CommandOf, JudgesAgainWhatIsHeldAgainstBaselines) {
  const Finding cost = finding(regression, "gl:x", "step=1", "more", Check::cost);
  judge::GateResult mine{.plan = "mine", .run = "r", .findings = {}};
  EXPECT_EQ(command_of(cost, mine), "") << "a store does not hold where the file is";
  mine.argument = "a b/mine.yaml";
  mine.defaults = {{"skip", "distance"}};
  mine.baselines = "b";
  EXPECT_EQ(command_of(cost, mine),
            "triptych gate 'a b/mine.yaml' --device gl:x --set skip=distance --set step=1 "
            "--measure --check cost --store repro.sqlite --baselines b");
}

TEST(CommandOf, MeasuresTimesAgainWhereTheyDecided) {
  judge::GateResult quick{.plan = "volume/quick", .run = "r", .findings = {}};
  const std::string command =
      "triptych gate volume/quick --device gl:x --set step=1 --measure --check timing --store "
      "repro.sqlite";
  const Finding slower = finding(regression, "gl:x", "step=1", "slower", Check::timing);
  EXPECT_EQ(command_of(slower, quick), command);
  quick.times_decided = true;
  EXPECT_EQ(command_of(slower, quick), command + " --times");
}

// By what is stored: a picture alone tells no error. An order is of all steps.
TEST(CommandOf, JudgesAnErrorAgain) {
  const judge::GateResult plan{.plan = "volume/accuracy", .run = "r", .findings = {}};
  EXPECT_EQ(
      command_of(finding(regression, "gl:x", "data=ball,step=1", "RMSE", Check::accuracy), plan),
      "triptych gate volume/accuracy --device gl:x --set data=ball --measure --check accuracy "
      "--store repro.sqlite");
}

TEST(CommandOf, DrawsTheLineThroughAllDevicesAgain) {
  const judge::GateResult cost{.plan = "volume/cost", .run = "r", .findings = {}};
  for (const char* configuration : {"", "step=1"}) {
    EXPECT_EQ(
        command_of(finding(regression, "gl:x", configuration, "off", Check::correlation), cost),
        "triptych gate volume/cost --measure --check correlation --store repro.sqlite");
  }
}

TEST(CommandOf, IsNothingWhereNoneShowsIt) {
  const judge::GateResult quick{.plan = "volume/quick", .run = "r", .findings = {}};
  EXPECT_EQ(command_of(finding(regression, "", ""), quick), "");
  EXPECT_EQ(command_of(finding(advisory, "gl:x", "step=1", "slower", Check::timing), quick), "");
}

}  // namespace
}  // namespace triptych::report
