// Tests measuring, accepting and judging from end to end, on scripted devices with known results.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <regex>

#include "correct_image.hpp"
#include "program.hpp"

namespace triptych::command_line {
namespace {

// `speed` is a factor on all times of the device.
std::string script(const std::filesystem::path& image_file, double speed, int seed) {
  return fmt::format(
      R"({{"images": {{"*": "{}"}}, "devices": [{}], "seed": {}, "base_ns": 5e6, "noise": 0.003}})",
      image_file.string(), speed, seed);
}

std::string measure_into(const std::string& store) {
  return fmt::format("run volume/quick {} --store {}", tiny, store);
}

std::string judge_from(const std::string& store) {
  return fmt::format("gate volume/quick --store {} --baselines baselines {}", store, tiny);
}

void accept_runs(const Program& program, const std::filesystem::path& image_file, int count) {
  for (int i = 0; i < count; ++i) {
    const std::string store = fmt::format("history{}.sqlite", i);
    ASSERT_EQ(program.run(measure_into(store), script(image_file, 1, i)).code, 0);
    const Result accepted = program.run(fmt::format(
        "accept volume/quick --reason history --store {} --baselines baselines", store));
    ASSERT_EQ(accepted.code, 0) << accepted.output;
  }
}

TEST(Gate, PassesIfNothingChanged) {
  const Program program;
  const auto image_file = correct_image(program);
  accept_runs(program, image_file, 1);
  ASSERT_EQ(program.run(measure_into("s.sqlite"), script(image_file, 1, 99)).code, 0);
  const Result judged = program.run(judge_from("s.sqlite") + " --junit j.xml --markdown m.md");
  EXPECT_EQ(judged.code, 0) << judged.output;
  EXPECT_TRUE(std::filesystem::exists(program.folder() / "j.xml"));
  EXPECT_EQ(program.run(judge_from("s.sqlite") + " --json").output,
            program.run(judge_from("s.sqlite") + " --json").output);
}

TEST(Gate, CannotJudgeWithoutBaselines) {
  const Program program;
  ASSERT_EQ(program.run(measure_into("s.sqlite"), script(correct_image(program), 1, 1)).code, 0);
  const Result judged = program.run(judge_from("s.sqlite"));
  EXPECT_EQ(judged.code, 2) << judged.output;
  const std::string words = judged.output.substr(judged.output.find("triptych accept"));
  EXPECT_TRUE(std::regex_search(words, std::regex("^triptych accept\\s+volume/quick\\s+--store\\s+"
                                                  "s.sqlite\\s+--baselines\\s+baselines\\s")))
      << judged.output;
}

// If a run did not read pipeline statistics, the gate must state this as the reason why it does not
// pass.
TEST(Gate, ACheckWithoutAVerdictIsSkippedInCTest) {
  const Program program;
  std::filesystem::create_directory(program.folder() / "baselines");
  ASSERT_EQ(program.run(measure_into("s.sqlite") + " --untimed").code, 0);
  ASSERT_EQ(program.run("accept volume/quick --reason x --store s.sqlite").code, 0);
  const Result tested = program.run(
      "test-check volume/quick --check statistics --device null:scripted --store s.sqlite");
  EXPECT_EQ(tested.code, 77) << tested.output;
  const Result judged = program.run(judge_from("s.sqlite") + " --check statistics");
  EXPECT_EQ(judged.code, 2);
  EXPECT_NE(judged.output.find("? statistics on null:scripted: no check reached a verdict for"),
            std::string::npos)
      << judged.output;
}

// The baselines of the program replace those of the working directory only if the gate names them.
TEST(Gate, NamesTheBaselinesThatReplaceMissingOnes) {
  const Program program;
  ASSERT_EQ(program.run(measure_into("s.sqlite") + " --untimed").code, 0);
  const std::string gate = fmt::format("gate volume/quick --store s.sqlite {}", tiny);
  const Result replaced = program.run(gate);
  EXPECT_NE(replaced.output.find("! compared with the baselines in"), std::string::npos)
      << replaced.output;
  std::filesystem::create_directory(program.folder() / "baselines");
  for (const std::string& options : {std::string(), std::string(" --baselines ./baselines")}) {
    const Result own = program.run(gate + options);
    EXPECT_EQ(own.output.find("compared with the baselines in"), std::string::npos) << own.output;
  }
}

TEST(Gate, APartialRunIsCompletedInItsOwnStore) {
  const Program program;
  const std::string accept = "accept volume/quick --reason x --baselines baselines --store ";
  ASSERT_EQ(program.run(measure_into("whole.sqlite") + " --set skip=none,bricks").code, 0);
  ASSERT_EQ(program.run(accept + "whole.sqlite").code, 0);
  ASSERT_EQ(program.run(measure_into("part.sqlite") + " --set skip=none").code, 0);
  const Result refused = program.run(accept + "part.sqlite");
  EXPECT_EQ(refused.code, 3);
  EXPECT_NE(refused.output.find("triptych run volume/quick --resume --store part.sqlite, accept"),
            std::string::npos)
      << refused.output;
}

// The factors `window` and `mapping`, which define how values are mapped to voxels, change the
// stored voxels of a volume, but not its name.
TEST(Gate, WindowsAndMappingsDoNotCountAsChangedData) {
  const Program program;
  program.write("plan", std::string(tiny_plan) +
                            "window: [full, 0.1..0.5, p10..p90]\nmapping: [linear, log]\n"
                            "voxel: [f32, u8]\nchecks: [counters]\n");
  ASSERT_EQ(program.run("run plan --device null:scripted --store s.sqlite").code, 0);
  const Result judged = program.run("gate plan --store s.sqlite --baselines none");
  EXPECT_EQ(judged.output.find("its data has changed"), std::string::npos) << judged.output;
  EXPECT_EQ(program.run("accept plan --reason x --store s.sqlite --baselines baselines").code, 0);
  const Result pass = program.run("gate plan --store s.sqlite --baselines baselines");
  EXPECT_EQ(pass.code, 0) << pass.output;
}

// After the file was edited, the store still contains the reference image that was drawn with the
// earlier contents. The gate must not compare with it.
TEST(Gate, AnEditedTransferFunctionInvalidatesTheReferenceImage) {
  const Program program;
  program.write("plan",
                "suite: volume\ntechnique: [raycast]\ndata: [generate:gaussian_blob:16]\n"
                "transfer_function: [a.rgba]\nviewport: [16]\n");
  for (const char opacity : {'\x10', '\x20'}) {
    program.write("a.rgba", std::string(1024, opacity));
    const std::filesystem::path image_file = correct_image(program, "a.rgba");
    const Result measured =
        program.run("run plan --device null:scripted --store s.sqlite", script(image_file, 1, 1));
    ASSERT_EQ(measured.code, 0) << measured.output;
    const Result judged = program.run("gate plan --check image --store s.sqlite --baselines none");
    EXPECT_EQ(judged.code, 2) << judged.output;  // no baselines
  }
}

TEST(Gate, AWrongImageIsARegression) {
  const Program program;
  accept_runs(program, correct_image(program), 1);
  // The null device draws its own pattern, which is wrong.
  ASSERT_EQ(program.run(measure_into("s.sqlite"), "{}").code, 0);
  EXPECT_EQ(program.run(judge_from("s.sqlite")).code, 1);
}

// A check that was not requested must appear neither on the page nor on the screen.
TEST(Gate, ThePageAgreesWithTheScreen) {
  const Program program;
  accept_runs(program, correct_image(program), 1);
  ASSERT_EQ(program.run(measure_into("s.sqlite"), "{}").code, 0);  // measures a wrong image
  EXPECT_EQ(program.run(judge_from("s.sqlite") + " --out all").code, 1);
  EXPECT_NE(program.read("all/report.html").find("<h1>FAIL (1)</h1>"), std::string::npos);
  EXPECT_EQ(program.run(judge_from("s.sqlite") + " --check counters --out one").code, 0);
  EXPECT_NE(program.read("one/report.html").find("<h1>PASS (0)</h1>"), std::string::npos);
}

TEST(Gate, AnUntimedRunIsJudgedByImagesAndCounters) {
  const Program program;
  const auto image_file = correct_image(program);
  accept_runs(program, image_file, 6);
  const Result untimed =
      program.run(measure_into("u.sqlite") + " --untimed", script(image_file, 1.2, 7));
  ASSERT_EQ(untimed.code, 0) << untimed.output;
  const Result judged = program.run(judge_from("u.sqlite"));
  EXPECT_EQ(judged.code, 0) << judged.output;
  ASSERT_EQ(program.run(measure_into("w.sqlite") + " --untimed", "{}").code, 0);
  EXPECT_EQ(program.run(judge_from("w.sqlite")).code, 1);
}

TEST(Gate, OutputsThatNeedTimesRejectAnUntimedRun) {
  const Program program;
  EXPECT_EQ(program.run(measure_into("u.sqlite") + " --untimed --error 0.1").code, 3);
}

TEST(Gate, AMissingRequiredDeviceDoesNotPass) {
  const Program program;
  const auto image_file = correct_image(program);
  accept_runs(program, image_file, 1);
  ASSERT_EQ(program.run(measure_into("s.sqlite"), script(image_file, 1, 1)).code, 0);
  const Result judged = program.run(judge_from("s.sqlite") + " --require 'vulkan:*'");
  EXPECT_EQ(judged.code, 2) << judged.output;
  EXPECT_NE(judged.output.find("vulkan:*"), std::string::npos);
}

// If an output file has the same name as another file of the command, the command is rejected
// before anything is judged, and nothing is written.
TEST(Gate, OutputsWithTheSameNameAreRejected) {
  const Program program;
  ASSERT_EQ(program.run(measure_into("s.sqlite"), script(correct_image(program), 1, 1)).code, 0);
  const std::string store = program.read("s.sqlite");
  for (const auto& [outputs, expected] :
       {std::pair("--junit s.sqlite",
                  "--junit s.sqlite names the same file as --store; choose another"),
        {"--markdown ./s.sqlite", "--markdown ./s.sqlite names the same file as --store"},
        {"--junit new --markdown ./new", "--markdown ./new names the same file as --junit"}}) {
    const Result judged = program.run(judge_from("s.sqlite") + " " + outputs);
    EXPECT_EQ(judged.code, 3) << judged.output;
    EXPECT_NE(judged.output.find(expected), std::string::npos) << judged.output;
  }
  program.write("plan.yaml", "suite: volume\n");
  EXPECT_EQ(program.run("gate plan.yaml --store s.sqlite --junit plan.yaml").code, 3);
  EXPECT_EQ(program.read("plan.yaml"), "suite: volume\n");
  EXPECT_EQ(program.read("s.sqlite"), store);
  EXPECT_FALSE(std::filesystem::exists(program.folder() / "new"));
  EXPECT_EQ(program.run(judge_from("s.sqlite") + " --junit /dev/null --markdown /dev/null").code,
            2);
}

TEST(Gate, AChangedBaselineIsReported) {
  const Program program;
  const auto image_file = correct_image(program);
  accept_runs(program, image_file, 1);
  program.write("baselines/volume/quick/counters.json", "{\n \"camera\": {\n");
  ASSERT_EQ(program.run(measure_into("s.sqlite"), script(image_file, 1, 1)).code, 0);
  const Result judged = program.run(judge_from("s.sqlite"));
  EXPECT_EQ(judged.code, 2) << judged.output;
  EXPECT_NE(judged.output.find("counters.json was changed"), std::string::npos) << judged.output;
}

TEST(Gate, AcceptNeedsAReasonAndNoInjectedFault) {
  const Program program;
  ASSERT_EQ(program.run(measure_into("s.sqlite") + " --inject half_voxel_shift").code, 0);
  EXPECT_EQ(program.run("accept volume/quick --store s.sqlite --baselines b --reason ok").code, 3);
  EXPECT_EQ(program.run("accept volume/quick --store s.sqlite --baselines b --reason ' '").code, 3);
  EXPECT_FALSE(std::filesystem::exists(program.folder() / "b"));
}

}  // namespace
}  // namespace triptych::command_line
