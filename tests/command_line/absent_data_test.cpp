// Tests CTest checks, gates and pages if a data file is missing that existed when the baselines
// were accepted.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "findings.hpp"
#include "program.hpp"

namespace triptych::command_line {
namespace {

class AbsentData : public testing::Test {
 protected:
  AbsentData() {
    program.write("plan",
                  "suite: volume\ntechnique: [raycast]\ndata: [field.nrrd]\n"
                  "transfer_function: [haze]\nviewport: [16]\n");
    program.write("field.nrrd",
                  "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n\n" +
                      std::string(64, 'x'));
  }

  [[nodiscard]] Result check(const std::string& name) const {
    return program.run("test-check plan --check " + name +
                       " --device null:scripted --store s.sqlite");
  }

  Program program;
};

TEST_F(AbsentData, SkipsCTestChecksAndCannotBeJudgedByTheGate) {
  ASSERT_EQ(program.run("run plan --device 'null:*' --store first.sqlite").code, 0);
  ASSERT_EQ(program.run("accept plan --reason new --baselines baselines --store first.sqlite").code,
            0);
  std::filesystem::remove(program.folder() / "field.nrrd");
  const Result measured = program.run("test-measure plan --device null:scripted --store s.sqlite");
  EXPECT_EQ(measured.code, 77) << measured.output;
  for (const char* name : {"image", "counters"}) {
    const Result result = check(name);
    EXPECT_EQ(result.code, 77) << result.output;
    EXPECT_NE(result.output.find("'field.nrrd' was not found"), std::string::npos) << result.output;
  }
  const Result gate = program.run("gate plan --baselines baselines --store s.sqlite");
  EXPECT_EQ(gate.code, 2) << gate.output;
  EXPECT_NE(gate.output.find("missing data files: 1 (field.nrrd)"), std::string::npos)
      << gate.output;
}

// A data file may be missing because its name is misspelled.
TEST_F(AbsentData, IsReportedByRunWithASimilarName) {
  program.write("plan",
                "suite: volume\ntechnique: [raycast]\ndata: [feild.nrrd, field.nrrd]\n"
                "transfer_function: [haze]\nstep: [1, 2]\nviewport: [16]\n");
  const Result result = program.run("run plan --device 'null:*' --store s.sqlite");
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_NE(result.output.find("  2 skipped on null:scripted: data file 'feild.nrrd' was not "
                               "found; did you mean 'field.nrrd'?\n"),
            std::string::npos)
      << result.output;
}

// A machine may lack data files on purpose, but there must be something left to judge.
TEST_F(AbsentData, CanBeExcusedUnlessNothingIsLeftToJudge) {
  ASSERT_EQ(program.run("run plan --device 'null:*' --store first.sqlite").code, 0);
  const std::string accept = "accept plan --reason new --baselines baselines --store ";
  ASSERT_EQ(program.run(accept + "first.sqlite").code, 0);
  std::filesystem::remove(program.folder() / "field.nrrd");
  ASSERT_EQ(program.run("run plan --device 'null:*' --store s.sqlite").code, 2);
  const std::string gate =
      "gate plan --check counters --without-data --baselines baselines --store ";
  EXPECT_EQ(program.run(gate + "s.sqlite").code, 2);
  program.write("plan",
                "suite: volume\ntechnique: [raycast]\ndata: [field.nrrd, "
                "generate:gaussian_blob:12]\ntransfer_function: [haze]\nviewport: [16]\n");
  ASSERT_EQ(program.run("run plan --device 'null:*' --store both.sqlite").code, 0);
  ASSERT_EQ(program.run(accept + "both.sqlite --only '*blob*'").code, 0);
  const Result excused = program.run(gate + "both.sqlite");
  EXPECT_EQ(excused.code, 0) << excused.output;
  EXPECT_EQ(
      program.run("gate plan --check counters --baselines baselines --store both.sqlite").code, 2);
}

// The page shows everything that is available: the times, the image, and the reason why the image
// cannot be judged.
TEST_F(AbsentData, LeavesAPageWithoutAReferenceImage) {
  ASSERT_EQ(program.run("run plan --device 'null:*' --store s.sqlite").code, 0);
  std::filesystem::remove(program.folder() / "field.nrrd");
  const Result reported = program.run("report --store s.sqlite --baselines b --out page.html");
  EXPECT_EQ(reported.code, 0) << reported.output;
  const std::string page = program.read("page.html");
  EXPECT_NE(page.find("no reference image: field.nrrd: not found"), std::string::npos);
  EXPECT_NE(page.find("data:image/png;base64,"), std::string::npos);
}

TEST_F(AbsentData, LeavesNoLimitImageToJudgeBy) {
  const Result run = program.run(
      "run volume/accuracy --device 'null:*' --untimed --set data=field.nrrd --set "
      "technique=raycast "
      "--set step=1 --set viewport=16 --set transfer_function=haze --store s.sqlite");
  ASSERT_EQ(run.code, 0) << run.output;
  std::filesystem::remove(program.folder() / "field.nrrd");
  const Result judged = program.run("gate volume/accuracy --store s.sqlite --baselines b --json");
  EXPECT_EQ(judged.code, 2) << judged.output;
  const auto unknown = findings_of(judged.output.substr(judged.output.find('{')), "unknown_error");
  ASSERT_FALSE(unknown.empty()) << judged.output;
  // The gate must report one finding for each measured configuration.
  EXPECT_NE(run.output.find(std::to_string(unknown.size()) + " measured, 0 skipped, 0 failed"),
            std::string::npos)
      << run.output;
  for (const core::Json& finding : unknown) {
    EXPECT_EQ(finding.at("verdict"), "cannot_judge");
    EXPECT_EQ(finding.at("device"), "null:scripted");
    const std::string detail = finding.at("detail");
    EXPECT_EQ(detail.substr(0, 23), "field.nrrd: not found (") << detail;
  }
  EXPECT_EQ(program.run("report --store s.sqlite --baselines b --out page.html").code, 0);
}

// Missing data of one configuration never excuse a device's failure in another.
TEST_F(AbsentData, DoesNotExcuseOtherFailures) {
  program.write("plan",
                "suite: volume\ntechnique: [raycast]\ndata: [field.nrrd, "
                "generate:gaussian_blob:12]\ntransfer_function: [haze]\nviewport: [16]\n");
  ASSERT_EQ(program.run("run plan --device 'null:*' --store first.sqlite").code, 0);
  ASSERT_EQ(program.run("accept plan --reason new --baselines baselines --store first.sqlite").code,
            0);
  std::filesystem::remove(program.folder() / "field.nrrd");
  ASSERT_NE(program
                .run("test-measure plan --device null:scripted --store s.sqlite",
                     R"({"failures": [{"kind": "crash", "frame": 2}]})")
                .code,
            77);
  EXPECT_EQ(check("counters").code, 1);
}

}  // namespace
}  // namespace triptych::command_line
