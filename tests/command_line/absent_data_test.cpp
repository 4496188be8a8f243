// CTest's checks where a file that was there when baselines were accepted is there no more.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

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

TEST_F(AbsentData, IsASkipForCTestAndNotToBeJudgedForTheGate) {
  ASSERT_EQ(program.run("run plan --device 'null:*' --store first.sqlite").code, 0);
  ASSERT_EQ(program.run("accept plan --reason new --baselines baselines --store first.sqlite").code,
            0);
  std::filesystem::remove(program.folder() / "field.nrrd");
  const Result measured = program.run("test-measure plan --device null:scripted --store s.sqlite");
  EXPECT_EQ(measured.code, 77) << measured.output;
  for (const char* name : {"image", "counters", "timing"}) {
    const Result result = check(name);
    EXPECT_EQ(result.code, 77) << result.output;
    EXPECT_NE(result.output.find("'field.nrrd' is not here"), std::string::npos) << result.output;
  }
  EXPECT_EQ(program.run("gate plan --baselines baselines --store s.sqlite").code, 2);
}

// A device that fails is never excused by what is not there elsewhere.
TEST_F(AbsentData, ExcusesNothingElse) {
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
