// Tests that the gate compares the compiler statistics of a run with the stored compiler
// statistics.

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include "fixture.hpp"
#include "judge/code/code_change.hpp"
#include "judge/code/code_totals.hpp"

namespace triptych::judge {
namespace {

using core::ExitCode;
using record::Code;
using testing::ElementsAre;
using testing::HasSubstr;

const Code as_compiled{{"raycast.comp",
                        {.statistics = {{"Instructions", 657},
                                        {"Subgroups per SIMD", 16},
                                        {"VGPRs", 84},
                                        {"Inverse Throughput", 6486},
                                        {"Latency", 41715},
                                        {"Spilled VGPRs", 0},
                                        {"Something new", 5}},
                         .assembly = "aaaa"}}};

Code with_changes(const std::map<std::string, double>& changes) {
  Code code = as_compiled;
  for (const auto& [name, value] : changes) code.at("raycast.comp").statistics[name] = value;
  return code;
}

CodeDirection direction_of(const std::map<std::string, double>& changes) {
  return compare_code(as_compiled, with_changes(changes)).direction();
}

TEST(CodeChange, NothingChanged) {
  EXPECT_EQ(direction_of({}), CodeDirection::same);
}

TEST(CodeChange, TheStatisticDeterminesWhatIsWorse) {
  EXPECT_EQ(direction_of({{"Instructions", 658}}), CodeDirection::worse);
  EXPECT_EQ(direction_of({{"Instructions", 656}}), CodeDirection::better);
  EXPECT_EQ(direction_of({{"Subgroups per SIMD", 12}}), CodeDirection::worse);
  EXPECT_EQ(direction_of({{"Subgroups per SIMD", 20}}), CodeDirection::better);
  EXPECT_EQ(direction_of({{"Spilled VGPRs", 1}}), CodeDirection::worse);
}

// Using more registers matters only if it reduces the occupancy.
TEST(CodeChange, RegistersAndUnknownStatisticsDoNotAffectTheVerdict) {
  EXPECT_EQ(direction_of({{"VGPRs", 88}}), CodeDirection::other);
  EXPECT_EQ(direction_of({{"Something new", 6}}), CodeDirection::other);
}

TEST(CodeChange, TheInverseThroughputDecidesAMixedChange) {
  EXPECT_EQ(direction_of({{"Instructions", 700}, {"Inverse Throughput", 6000}}),
            CodeDirection::better);
  EXPECT_EQ(direction_of({{"Instructions", 600}, {"Inverse Throughput", 7000}}),
            CodeDirection::worse);
  EXPECT_EQ(direction_of({{"Instructions", 700}, {"Latency", 40000}}), CodeDirection::worse);
  EXPECT_TRUE(
      compare_code(as_compiled, with_changes({{"Instructions", 700}, {"Latency", 40000}})).mixed());
}

// OpenGL drivers report no instruction counts for vertex and fragment shaders.
TEST(CodeChange, TheCodeSizeDecidesIfInstructionsAreNotReported) {
  const auto with = [](std::map<std::string, double> statistics) {
    return Code{{"sphere.frag", {.statistics = std::move(statistics)}}};
  };
  const auto direction = [](const Code& before, const Code& now) {
    return compare_code(before, now).direction();
  };
  EXPECT_EQ(direction(with({{"Code Size", 664}}), with({{"Code Size", 668}})),
            CodeDirection::worse);
  EXPECT_EQ(direction(with({{"Code Size", 664}}), with({{"Code Size", 660}})),
            CodeDirection::better);
  EXPECT_EQ(direction(with({{"Code Size", 664}, {"Instructions", 90}}),
                      with({{"Code Size", 668}, {"Instructions", 90}})),
            CodeDirection::same);
}

TEST(CodeChange, AMissingStatisticIsNotZero) {
  Code without = as_compiled;
  without.at("raycast.comp").statistics.erase("Instructions");
  EXPECT_TRUE(compare_code(as_compiled, without).changes.empty());
  EXPECT_TRUE(compare_code(without, as_compiled).changes.empty());
}

TEST(CodeTotals, MatchTheTotalsThatMesaDevelopersUse) {
  CodeTotals totals;
  totals.add("a", as_compiled, with_changes({{"Instructions", 647}}));
  totals.add("b", as_compiled, with_changes({{"Instructions", 660}}));
  totals.add("c", as_compiled, as_compiled);
  const CodeTotal& instructions = totals.totals().at("Instrs");
  EXPECT_EQ(instructions.before, 1971);
  EXPECT_EQ(instructions.now, 1964);
  EXPECT_EQ(instructions.less, 10);
  EXPECT_EQ(instructions.more, 3);
  EXPECT_EQ(instructions.helped, 1U);
  EXPECT_EQ(instructions.hurt, 1U);
  EXPECT_EQ(instructions.worst, "b");
  EXPECT_EQ(totals.changed(), 2U);
}

TEST(CodeTotals, FewerWavesAreWorse) {
  CodeTotals totals;
  totals.add("a", as_compiled, with_changes({{"Subgroups per SIMD", 12}}));
  const CodeTotal& waves = totals.totals().at("MaxWaves");
  EXPECT_EQ(waves.helped, 0U);
  EXPECT_EQ(waves.hurt, 1U);
  EXPECT_EQ(waves.worst_before, 16);
  EXPECT_EQ(waves.worst_now, 12);
}

class CodeGateTest : public JudgeTest {
 protected:
  CodeGateTest() {
    request_.checks = {Check::code};
    checks_ = {Check::code};
  }

  static Tweak compiled(const std::function<void(record::Record&)>& change = {}) {
    return [change](record::Record& record, core::Image&) {
      record.code = as_compiled;
      if (change) change(record);
    };
  }
  // Returns a change of the code of one configuration on one device.
  static Tweak changed(const std::map<std::string, double>& changes) {
    return compiled([=](record::Record& record) {
      if (record.device != "vulkan:lavapipe" || record.configuration != plain_) return;
      record.code = with_changes(changes);
    });
  }
  GateResult judge(const Tweak& change) {
    accept_first(compiled());
    add_run("b", change);
    return gate("b");
  }
};

TEST_F(CodeGateTest, TheSameCodePasses) {
  const GateResult result = judge(compiled());
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  EXPECT_EQ(with(result, Verdict::pass, Check::code).size(), 12U);
}

TEST_F(CodeGateTest, OneInstructionIsARegression) {
  const GateResult result = judge(changed({{"Instructions", 658}}));
  const auto wrong = with(result, Verdict::regression, Check::code);
  ASSERT_EQ(wrong.size(), 1U) << text(result);
  EXPECT_EQ(wrong[0].device, "vulkan:lavapipe");
  EXPECT_EQ(wrong[0].configuration, plain_);
  EXPECT_EQ(wrong[0].cause, Cause::values_changed);
  ASSERT_EQ(wrong[0].changes.size(), 1U);
  EXPECT_EQ(wrong[0].changes[0].name, "instructions");
  EXPECT_EQ(wrong[0].changes[0].before, 657);
  EXPECT_EQ(wrong[0].changes[0].now, 658);
  EXPECT_EQ(result.exit_code(), ExitCode::regression);
}

TEST_F(CodeGateTest, OneInstructionLessIsAnImprovement) {
  const GateResult result = judge(changed({{"Instructions", 656}}));
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  EXPECT_EQ(with(result, Verdict::improved, Check::code).size(), 1U);
}

TEST_F(CodeGateTest, OtherPartsCannotBeCompared) {
  const GateResult result = judge(compiled([](record::Record& record) {
    if (record.configuration != plain_) return;
    record.code["another.comp"] = record.code.at("raycast.comp");
  }));
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge) << text(result);
  EXPECT_EQ(with(result, Verdict::cannot_judge, Check::code).at(0).cause, Cause::other_executables);
}

// The compiler crashes, or it rejects a shader that it used to accept.
TEST_F(CodeGateTest, AFailureToCompileIsARegression) {
  const GateResult result = judge(compiled([](record::Record& record) {
    if (record.device != "vulkan:lavapipe" || record.configuration != plain_) return;
    record.code.clear();
    record.outcome = record::Outcome::crashed;
  }));
  EXPECT_EQ(result.exit_code(), ExitCode::regression) << text(result);
}

TEST_F(CodeGateTest, AnotherDriverVersionIsReportedInTotals) {
  accept_first(compiled());
  for (const char* id : {"gl:llvmpipe-egl", "opencl:pocl", "vulkan:lavapipe"}) {
    driver_versions_[id] = "25.0.7";
  }
  add_run("b", compiled([](record::Record& record) {
            record.code = with_changes({{"Instructions", 700}});
          }));
  const auto unjudged = with(gate("b"), Verdict::cannot_judge, Check::code);
  ASSERT_EQ(unjudged.size(), 3U);
  EXPECT_EQ(unjudged[0].cause, Cause::other_compiler);
  EXPECT_EQ(unjudged[0].changes.at(0).name, "Instrs");
  EXPECT_EQ(unjudged[0].advice.advice, Advice::accept_or_compare);
  EXPECT_EQ(with(gate("b"), Verdict::regression).size(), 0U);
}

// A machine need not have a compiler for every GPU family. But if the driver is installed and lacks
// an accepted family, the driver must have lost it.
TEST_F(CodeGateTest, AMissingFamilyIsReportedOnlyIfItsDriverExists) {
  const std::vector<std::string> others{"opencl:pocl", "vulkan:lavapipe"};
  const std::vector<std::string> configurations{
      plain_, bricks_, "camera=side,data=ball,technique=raycast",
      "camera=side,data=ball,skip=bricks,technique=raycast"};
  const auto run = [&](const std::string& id, std::vector<std::string> found) {
    const std::vector<std::string> devices = id == "a" ? found : others;
    add_run(id, compiled());
    store_.begin(id, {.host = "host", .found = std::move(found), .devices = devices},
                 configurations);
    if (id == "a") return;
    SQLite::Database rows(store_.file().string(), SQLite::OPEN_READWRITE);
    rows.exec("DELETE FROM record WHERE run = '" + id + "' AND device = 'gl:llvmpipe-egl'");
    rows.exec("DELETE FROM device WHERE run = '" + id + "' AND id = 'gl:llvmpipe-egl'");
  };
  run("a", {"gl:llvmpipe-egl", "opencl:pocl", "vulkan:lavapipe"});
  static_cast<void>(accept_run("a"));
  run("without", others);
  EXPECT_EQ(gate("without").exit_code(), ExitCode::pass) << text(gate("without"));
  run("lost", {"gl:llvmpipe-other", "opencl:pocl", "vulkan:lavapipe"});
  const GateResult lost = gate("lost");
  EXPECT_EQ(lost.exit_code(), ExitCode::cannot_judge) << text(lost);
  const auto missing = with(lost, Verdict::cannot_judge);
  ASSERT_EQ(missing.size(), 1U);
  EXPECT_EQ(missing[0].cause, Cause::device_missing);
  EXPECT_EQ(missing[0].device, "gl:llvmpipe-egl");
}

}  // namespace
}  // namespace triptych::judge
