#include "report/finding_command.hpp"

#include <gmock/gmock.h>

#include <cstdlib>

#include "findings.hpp"
#include "report/command.hpp"
#include "report/words/command_note.hpp"

namespace triptych::report {
namespace {

using judge::Check;
using judge::Finding;
using testing::HasSubstr;
using testing::Not;
using enum judge::Verdict;

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
    EXPECT_EQ(
        command_of(finding(regression, "gl:x", configuration, off_the_line, Check::correlation),
                   cost),
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
