// Tests worker processes that crash or hang, and the records that remain.

#include <gtest/gtest.h>

#include "program.hpp"

namespace triptych::command_line {
namespace {

// Options for three configurations. The configuration with step 0.5 has the fault.
const std::string three =
    std::string("run volume/quick ") + tiny + " --set step=0.25,0.5,1 --store s.sqlite";

TEST(Faults, ACrashCostsOneConfiguration) {
  const Program program;
  const Result result = program.run(three + " --inject 'crash@*step=0.5*'");
  EXPECT_NE(result.output.find("2 measured, 0 skipped, 1 failed"), std::string::npos)
      << result.output;
  EXPECT_NE(result.output.find("crashed"), std::string::npos) << result.output;
}

TEST(Faults, AHangCostsOneConfiguration) {
  const Program program;
  const Result result = program.run(three + " --limit 1 --inject 'hang@*step=0.5*'");
  EXPECT_NE(result.output.find("2 measured, 0 skipped, 1 failed"), std::string::npos)
      << result.output;
  EXPECT_NE(result.output.find("hung"), std::string::npos) << result.output;
}

// The names of Triptych's functions are in the stack only if the program exports them.
TEST(Faults, ACrashAndAHangAreReportedWithTheNamesOfTheFunctions) {
  const Program program;
  for (const char* fault : {"crash", "hang"}) {
    const Result result = program.run(std::string("render volume ") + tiny +
                                      " --out frame --limit 2 --inject " + fault);
    EXPECT_EQ(result.code, 3) << result.output;
    for (const char* function : {"libc", "triptych7measure6inject", "serve_worker"}) {
      EXPECT_NE(result.output.find(function), std::string::npos) << fault << result.output;
    }
  }
}

// The plan's level "haze" is a default, so it does not appear in the name of any configuration, and
// a pattern that contains "haze" matches nothing.
TEST(Faults, AFaultWithoutEffectIsReported) {
  const Program program;
  const Result missed = program.run(three + " --inject 'crash@*haze*'");
  EXPECT_EQ(missed.code, 0) << missed.output;
  EXPECT_NE(missed.output.find("--inject crash@*haze* has no effect"), std::string::npos)
      << missed.output;
  const Result hit = program.run(three + " --inject 'extra_sample@null:*'");
  EXPECT_EQ(hit.output.find("has no effect"), std::string::npos) << hit.output;
}

TEST(Faults, ALostDeviceCostsOneConfiguration) {
  const Program program;
  const Result result = program.run(three + " --inject 'device_lost@*step=0.5*'");
  EXPECT_NE(result.output.find("2 measured, 0 skipped, 1 failed"), std::string::npos)
      << result.output;
}

TEST(Faults, AKilledRunIsResumed) {
  const Program program;
  // The first configuration is stored. The second one hangs until the main process is killed.
  const Result killed =
      program.run(three + " --limit 60 --inject 'hang@*step=0.5*'", "{}", "timeout -s KILL 3");
  EXPECT_NE(killed.code, 0);
  const Result resumed = program.run(three + " --resume");
  EXPECT_EQ(resumed.code, 0) << resumed.output;
  EXPECT_NE(resumed.output.find("3 measured, 0 skipped, 0 failed"), std::string::npos)
      << resumed.output;
  EXPECT_NE(resumed.output.find("1 of these results were already in the store"), std::string::npos)
      << resumed.output;
}

// The summary covers everything that a resumed run contains, not only what was measured after
// resuming.
TEST(Faults, AResumedRunReportsAllItsRecords) {
  const Program program;
  const std::string run = std::string("run volume/quick --set step=0.5,1 --set skip=none --set ") +
                          "camera=orbit_y:1/8 --store s.sqlite " + tiny;
  ASSERT_EQ(program.run(run + "").code, 0);
  const Result finished = program.run(run + " --resume");
  EXPECT_EQ(finished.code, 0) << finished.output;
  EXPECT_NE(finished.output.find(": 2 measured, 0 skipped, 0 failed"), std::string::npos)
      << finished.output;
  EXPECT_NE(finished.output.find("2 of these results were already in the store\n"),
            std::string::npos)
      << finished.output;
}

TEST(Faults, NothingMeasuredDoesNotPass) {
  const Program program;
  const Result result =
      program.run("run volume/quick --device 'null:*' --set data=gone.nrrd --store s.sqlite");
  EXPECT_EQ(result.code, 2) << result.output;
  EXPECT_EQ(program.run("gate volume/quick --store s.sqlite --baselines b").code, 2);
}

TEST(Faults, ARunThatMeasuredNothingDoesNotSucceed) {
  const Program program;
  const std::string run = std::string("run volume/quick --store s.sqlite ") + tiny;
  const Result crashed = program.run(run + " --inject crash");
  EXPECT_EQ(crashed.code, 2) << crashed.output;
  EXPECT_NE(crashed.output.find(" 0 measured, "), std::string::npos) << crashed.output;
}

}  // namespace
}  // namespace triptych::command_line
