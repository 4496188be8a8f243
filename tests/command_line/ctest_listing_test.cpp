// Tests the list of tests that `triptych ctest` writes for CTest.

#include <gmock/gmock.h>

#include <filesystem>
#include <iterator>

#include "program.hpp"

namespace triptych::command_line {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string tests_of(const Program& program, const std::string& plan) {
  const Result listed = program.run("ctest " + plan + " --out tests.cmake --folder .");
  EXPECT_EQ(listed.code, 0) << listed.output;
  return program.read("tests.cmake");
}

// Errors, convergence orders, counters and images need no times, so plans with only these checks
// are not timed.
TEST(CTestListing, AccuracyIsMeasuredWithoutTimes) {
  const Program program;
  for (const std::string plan : {"volume/accuracy", "particles/accuracy"}) {
    const std::string stem = plan == "volume/accuracy" ? "volume.accuracy" : "particles.accuracy";
    const std::string tests = tests_of(program, plan);
    for (const char* test : {".measure.", ".image.", ".counters.", ".accuracy.", ".agreement"}) {
      EXPECT_THAT(tests, HasSubstr("[=[" + stem + test));
    }
    EXPECT_THAT(tests, Not(HasSubstr(".timing.")));
    EXPECT_THAT(tests, Not(HasSubstr(".statistics.")));
  }
}

TEST(CTestListing, OtherPlansAreTimed) {
  const Program program;
  const std::string tests = tests_of(program, "volume/quick");
  EXPECT_THAT(tests, Not(HasSubstr("--untimed")));
  EXPECT_THAT(tests, HasSubstr("volume.quick.timing."));
  EXPECT_THAT(tests, HasSubstr("volume.quick.statistics."));
}

}  // namespace
}  // namespace triptych::command_line
