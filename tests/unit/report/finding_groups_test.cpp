#include "report/finding_groups.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>

#include "findings.hpp"
#include "report/command.hpp"
#include "report/words/command_note.hpp"

namespace triptych::report {
namespace {

using judge::Check;
using judge::Finding;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using enum judge::Verdict;

Finding finding(judge::Verdict verdict, const std::string& device, const std::string& configuration,
                const judge::Observation& what = over_bound(3), Check check = Check::image) {
  return finding_of(check, verdict, device, configuration, what);
}

const judge::Observation costlier = changed("device_code");
const judge::Observation off{.cause = judge::Cause::residual_moved};

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
  std::vector<Finding> findings{finding(regression, "gl:x", "step=1", costlier, Check::cost),
                                finding(regression, "gl:x", "step=1", off, Check::correlation),
                                finding(regression, "gl:x", "", off, Check::correlation)};
  ASSERT_EQ(grouped(findings).size(), 1U);
  EXPECT_EQ(grouped(findings)[0].first, findings.data());
  findings.push_back(finding(regression, "gl:x", "step=2", off, Check::correlation));
  findings.push_back(finding(regression, "gl:y", "", off, Check::correlation));
  EXPECT_EQ(grouped(findings).size(), 3U);
}

// The variables come from a store, which anybody may have written.
TEST(AllowedEnvironment, ContainsNoVariableThatCouldRunCodeOrWriteFiles) {
  using Variables = std::map<std::string, std::string>;
  const Variables harmless{
      {"GALLIUM_DRIVER", "llvmpipe"}, {"LP_NUM_THREADS", "1"}, {"MESA_GL_VERSION_OVERRIDE", "3.3"}};
  EXPECT_EQ(allowed_environment(harmless), harmless);
  for (const auto& [name, value] : Variables{{"LD_PRELOAD", "evil.so"},
                                             {"PATH", "."},
                                             {"VK_DRIVER_FILES", "evil.json"},
                                             {"OCL_ICD_VENDORS", "evil"},
                                             {"LP_X;id", "1"},
                                             {"LP_X $(id)", "1"},
                                             {"LP_X", "/tmp/evil.so"},
                                             {"LP_Y", "x=1"},
                                             {"GALLIUM_LOG_FILE", "results.sqlite"},
                                             {"GALLIUM_TRACE", "results.sqlite"},
                                             {"MESA_SHADER_DUMP_PATH", ".."},
                                             {"MESA_SHADER_CACHE_DIR", ".."},
                                             {"TRIPTYCH_DUMP", ".."}}) {
    EXPECT_EQ(allowed_environment({{name, value}}), Variables()) << name;
  }
  // A value that is set here anyway adds no risk.
  ::setenv("VK_DRIVER_FILES", "mine.json", 1);
  EXPECT_EQ(allowed_environment({{"VK_DRIVER_FILES", "mine.json"}}),
            (Variables{{"VK_DRIVER_FILES", "mine.json"}}));
  EXPECT_EQ(allowed_environment({{"VK_DRIVER_FILES", "evil.json"}}), Variables());
  ::unsetenv("VK_DRIVER_FILES");

  judge::GateResult quick{.plan = "volume/quick", .run = "r", .findings = {}};
  quick.environments = {{"gl:x", {{"LD_PRELOAD", "evil.so"}, {"LP_X;id", "1"}}}};
  EXPECT_THAT(command_of(finding(regression, "gl:x", "step=1"), quick),
              testing::StartsWith("triptych render volume"));
}

// The driver version is stated because a command without these variables may use another driver.
TEST(CommandNote, NamesTheVariablesThatTheCommandLeavesOut) {
  const Finding wrong = finding(regression, "gl:x", "step=1");
  judge::GateResult quick{.plan = "volume/quick", .run = "r", .findings = {}};
  quick.environments = {{"gl:x", {{"LP_NUM_THREADS", "1"}, {"TRIPTYCH_UNSET_VARIABLE", "/mine"}}}};
  quick.tested["gl:x"].driver_version = "Mesa 25.0.7";
  EXPECT_THAT(words::command_note(wrong, quick),
              testing::AllOf(HasSubstr("TRIPTYCH_UNSET_VARIABLE"), HasSubstr("Mesa 25.0.7"),
                             Not(HasSubstr("LP_NUM_THREADS"))));
  ::setenv("TRIPTYCH_UNSET_VARIABLE", "/mine", 1);
  EXPECT_EQ(words::command_note(wrong, quick), "");
  ::unsetenv("TRIPTYCH_UNSET_VARIABLE");
  EXPECT_EQ(words::command_note(finding(regression, "gl:x", ""), quick), "")
      << "there is no command";
}

TEST(CommandOf, PrintsStoredStatisticsOfCompiledCode) {
  const Finding larger =
      finding(regression, "vulkan:x", "technique=raycast", changed("instructions"), Check::code);
  judge::GateResult code{.plan = "volume/code", .run = "r", .findings = {}};
  const std::string command =
      "triptych code volume --device vulkan:x --set technique=raycast --brief";
  EXPECT_EQ(command_of(larger, code), command);
  code.plan = "mine";
  code.baselines = "b";
  EXPECT_EQ(command_of(larger, code), command + " --stored mine --baselines b");
}

TEST(CommandOf, RendersTheConfiguration) {
  const Finding wrong = finding(regression, "gl:x#2", "data=a b%2Cc,step=0.5");
  judge::GateResult quick{.plan = "volume/quick", .run = "r", .findings = {}};
  quick.environments = {{"gl:x#2", {{"LP_X", "$(x)"}}}};
  EXPECT_EQ(command_of(wrong, quick),
            "LP_X='$(x)' triptych render volume --device 'gl:x#2' --set 'data=a b%2Cc' --set "
            "step=0.5 --truth --out repro");
  Finding injected = wrong;
  injected.injected = {"coarse_filter"};
  EXPECT_THAT(command_of(injected, quick), HasSubstr(" --inject coarse_filter --truth --out"));
  Finding hung = finding(
      regression, "gl:x", "step=1",
      ended(record::Outcome::hung, {.cause = record::Cause::timeout, .numbers = {{"limit_s", 2}}}));
  EXPECT_THAT(command_of(hung, quick), HasSubstr(" --limit 2 --truth --out"));
  hung.reason.numbers["limit_s"] = 60;  // the default limit of `render`
  EXPECT_THAT(command_of(hung, quick), Not(HasSubstr("--limit")));
}

// To reproduce a finding that is based on stored values, the command must also compare with them:
// it judges a single configuration of the plan, with the plan argument that the user typed.
TEST(CommandOf, JudgesFindingsAboutBaselinesAgain) {
  const Finding cost = finding(regression, "gl:x", "step=1", costlier, Check::cost);
  judge::GateResult mine{.plan = "mine", .run = "r", .findings = {}};
  EXPECT_EQ(command_of(cost, mine), "") << "a store does not contain the path of the plan file";
  mine.argument = "a b/mine.yaml";
  mine.defaults = {{"skip", "distance"}};
  mine.baselines = "b";
  EXPECT_EQ(command_of(cost, mine),
            "triptych gate 'a b/mine.yaml' --device gl:x --set skip=distance --set step=1 "
            "--measure --check cost --store repro.sqlite --baselines b");
}

TEST(CommandOf, MeasuresTimesIfTheyDecidedTheVerdict) {
  judge::GateResult quick{.plan = "volume/quick", .run = "r", .findings = {}};
  const std::string command =
      "triptych gate volume/quick --device gl:x --set step=1 --measure --check timing --store "
      "repro.sqlite";
  const Finding slower = finding(regression, "gl:x", "step=1",
                                 judge::Observation{.cause = judge::Cause::time}, Check::timing);
  EXPECT_EQ(command_of(slower, quick), command);
  quick.times_decided = true;
  EXPECT_EQ(command_of(slower, quick), command + " --times");
}

// The command must judge the error again with the gate, because `render` compares an image neither
// with stored values nor with the images of all step sizes, which an order of convergence needs.
TEST(CommandOf, JudgesAnErrorAgain) {
  const judge::GateResult plan{.plan = "volume/accuracy", .run = "r", .findings = {}};
  EXPECT_EQ(
      command_of(finding(regression, "gl:x", "data=ball,step=1",
                         judge::Observation{.cause = judge::Cause::error}, Check::accuracy),
                 plan),
      "triptych gate volume/accuracy --device gl:x --set data=ball --measure --check accuracy "
      "--store repro.sqlite");
}

TEST(CommandOf, RepeatsTheCorrelationOfAllDevices) {
  const judge::GateResult cost{.plan = "volume/cost", .run = "r", .findings = {}};
  for (const char* configuration : {"", "step=1"}) {
    EXPECT_EQ(command_of(finding(regression, "gl:x", configuration, off, Check::correlation), cost),
              "triptych gate volume/cost --measure --check correlation --store repro.sqlite");
  }
}

// Every command would fail, because the data file is still missing.
TEST(CommandOf, IsEmptyIfADataFileIsMissing) {
  const judge::GateResult quick{.plan = "volume/quick", .run = "r", .findings = {}};
  const record::Reason unsupported{.cause = record::Cause::not_supported};
  record::Reason no_file = unsupported;
  no_file.subject = "tooth.nrrd";
  for (const auto& [reason, empty] : {std::pair{unsupported, false}, std::pair{no_file, true}}) {
    const Finding finding_of_skip =
        finding(cannot_judge, "gl:x", "step=1", ended(record::Outcome::skipped, reason));
    EXPECT_EQ(command_of(finding_of_skip, quick).empty(), empty);
  }
}

TEST(CommandOf, IsEmptyIfNoCommandReproducesTheFinding) {
  const judge::GateResult quick{.plan = "volume/quick", .run = "r", .findings = {}};
  EXPECT_EQ(command_of(finding(regression, "", ""), quick), "");
  EXPECT_EQ(command_of(finding(advisory, "gl:x", "step=1",
                               judge::Observation{.cause = judge::Cause::time}, Check::timing),
                       quick),
            "");
}

}  // namespace
}  // namespace triptych::report
