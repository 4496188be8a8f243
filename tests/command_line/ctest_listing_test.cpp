// The tests that CTest is told of.

#include <gmock/gmock.h>

#include <filesystem>
#include <iterator>

#include "program.hpp"

namespace triptych::command_line {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string tests_of(const Program& program, const std::string& plan,
                     const std::string& wrapper = "") {
  const Result listed =
      program.run("ctest " + plan + " --out tests.cmake --folder .", "{}", wrapper);
  EXPECT_EQ(listed.code, 0) << listed.output;
  return program.read("tests.cmake");
}

// Errors, orders, counters and pictures need no times.
TEST(CTestListing, AccuracyIsMeasuredWithoutTimes) {
  const Program program;
  for (const std::string plan : {"volume/accuracy", "particles/accuracy"}) {
    const std::string stem = plan == "volume/accuracy" ? "volume.accuracy" : "particles.accuracy";
    const std::string tests = tests_of(program, plan);
    for (const char* test : {".measure.", ".image.", ".counters.", ".accuracy.", ".agreement"}) {
      EXPECT_THAT(tests, HasSubstr("[=[" + stem + test));
    }
    EXPECT_THAT(tests, HasSubstr("[=[--untimed]=]"));
    EXPECT_THAT(tests, Not(HasSubstr(".timing.")));
    EXPECT_THAT(tests, Not(HasSubstr(".statistics.")));
  }
}

// Times are judged by what the anchors beside them show.
TEST(CTestListing, AnchorsAreMeasuredBesideTimes) {
  const Program program;
  for (const std::string plan : {"volume/quick", "particles/correlation"}) {
    EXPECT_THAT(tests_of(program, plan), HasSubstr("[=[anchors/frozen]=] [=[" + plan + "]=]"));
  }
  EXPECT_THAT(tests_of(program, "anchors/frozen"),
              HasSubstr("[=[test-measure]=] [=[anchors/frozen]=] [=[--device]=]"));
  for (const std::string plan : {"volume/stress", "particles/accuracy"}) {
    EXPECT_THAT(tests_of(program, plan), Not(HasSubstr("[=[anchors/frozen]=]")));
  }
}

// Nothing is to be judged where no data is there.
TEST(CTestListing, NoAnchorsAreMeasuredBesideAbsentData) {
  const Program program;
  EXPECT_THAT(tests_of(program, "volume/real"), Not(HasSubstr("anchors/frozen")));
  program.write("ct_tooth_103x94x161_u16.nrrd", "");
  EXPECT_THAT(tests_of(program, "volume/real", "env TRIPTYCH_DATA=."),
              HasSubstr("[=[anchors/frozen]=] [=[volume/real]=]"));
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
