// Tests that none of the following passes: a run that was cut short, a machine that lost a device,
// and a plan that lost a check.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"

namespace triptych::command_line {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* two_devices = R"({"devices": [1, 1.7]})";
const std::string memory_plan = std::string(tiny_plan) + "checks: [counters, memory]\n";

class CutShort : public testing::Test {
 protected:
  CutShort() {
    program.write("p.yaml", memory_plan);
    program.write("both.yaml",
                  std::string(tiny_plan) + "step: [1, 0.5]\nchecks: [counters, memory]\n");
  }
  // Runs the plan on two devices, and accepts the run.
  void accept(const std::string& plan = "p.yaml") {
    const std::string options = " --store accepted.sqlite";
    Result result = program.run("run " + plan + " --device 'null:*'" + options, two_devices);
    ASSERT_EQ(result.code, 0) << result.output;
    result = program.run("accept " + plan + " --reason x --baselines b" + options, two_devices);
    ASSERT_EQ(result.code, 0) << result.output;
  }
  [[nodiscard]] Result gate(const std::string& more = "",
                            const std::string& plan = "p.yaml") const {
    return program.run("gate " + plan + " --store s.sqlite --baselines b " + more, two_devices);
  }
  [[nodiscard]] Result run(const std::string& script, const std::string& more = "",
                           const std::string& wrapper = "") const {
    return program.run("run p.yaml --device 'null:*' --store s.sqlite " + more, script, wrapper);
  }

  Program program;
};

TEST_F(CutShort, ACompleteRunPasses) {
  accept();
  ASSERT_EQ(run(two_devices).code, 0);
  EXPECT_EQ(gate().code, 0) << gate().output;
  EXPECT_EQ(program.run("merge --check s.sqlite").code, 0);
}

// Kills the program while the second device draws its first frame, which takes 10 s.
TEST_F(CutShort, AKilledRunIsReported) {
  accept();
  const std::string slow =
      R"({"devices": [1, 10000], "base_ns": 1e6, "ns_per_sample": 0, "sleep": true})";
  ASSERT_NE(run(slow, "", "timeout -s KILL 8").code, 0);
  const Result judged = gate();
  EXPECT_EQ(judged.code, 2) << judged.output;
  EXPECT_THAT(judged.output, AllOf(HasSubstr("null:scripted#2"), HasSubstr("--resume")));
  const Result checked = program.run("merge --check s.sqlite");
  EXPECT_EQ(checked.code, 2) << checked.output;
  EXPECT_THAT(checked.output, HasSubstr("null:scripted#2"));
  const Result accepted = program.run("accept p.yaml --reason x --baselines new --store s.sqlite");
  EXPECT_EQ(accepted.code, 3) << accepted.output;
  ASSERT_EQ(run(two_devices, "--resume").code, 0);
  EXPECT_EQ(gate().code, 0) << gate().output;
}

TEST_F(CutShort, AnEmptyShardIsReported) {
  accept("both.yaml");
  const std::string shard = "--device 'null:*' --store s.sqlite --shard 3/3";
  EXPECT_EQ(program.run("run both.yaml " + shard, two_devices).code, 2);
  EXPECT_EQ(gate("--shard 3/3", "both.yaml").code, 2);
  EXPECT_EQ(program.run("merge --check s.sqlite").code, 2);
}

TEST_F(CutShort, AMissingDeviceIsReportedUnlessItIsExcused) {
  accept();
  ASSERT_EQ(run("{}").code, 0);
  const Result judged = gate("--json");
  EXPECT_EQ(judged.code, 2) << judged.output;
  EXPECT_THAT(judged.output, AllOf(HasSubstr("device_missing"), HasSubstr("--without-device")));
  EXPECT_EQ(gate("--without-device 'null:*#2'").code, 0);
  program.write("b/absent.json", R"([{"device": "null:scripted#2", "reason": "one is enough"}])");
  EXPECT_EQ(gate().code, 0) << gate().output;
}

// A crash, an invalid answer or an early exit during device enumeration does not end `run` itself,
// which must report the failure.
TEST_F(CutShort, AFailedListingIsReported) {
  for (const char* kind : {"crash", "garbage", "exit"}) {
    const Result result =
        run(std::string(R"({"failures": [{"kind": ")") + kind + R"(", "at": "list"}]})");
    EXPECT_EQ(result.code, 2) << kind << result.output;
  }
}

// The devices of another API are measured nevertheless. The failure must not be forgotten.
TEST_F(CutShort, AFailedListingOfOneApiOfSeveralIsReported) {
  const std::string crash = R"({"failures": [{"kind": "crash", "at": "list"}]})";
  const std::string given = " --store s.sqlite --baselines b";
  const Result measured =
      program.run("run p.yaml --store s.sqlite --device '*l:*' --device 'o*'", crash);
  if (measured.code != 0) GTEST_SKIP() << "needs an OpenCL device: " << measured.output;
  ASSERT_EQ(program.run("accept p.yaml --reason x" + given, crash).code, 0);
  const Result judged = program.run("gate p.yaml" + given, crash);
  EXPECT_EQ(judged.code, 2) << judged.output;
  EXPECT_THAT(judged.output, AllOf(HasSubstr("unusable on this machine: null: the worker was"),
                                   HasSubstr("device enumeration failed for null")));
}

TEST_F(CutShort, APlanThatLostAcceptedChecksIsReported) {
  accept();
  program.write("p.yaml", std::string(tiny_plan) + "checks: [memory]\n");
  ASSERT_EQ(run(two_devices).code, 0);
  const Result judged = gate("--json");
  EXPECT_EQ(judged.code, 2) << judged.output;
  EXPECT_THAT(judged.output, HasSubstr("checks_lost"));
}

TEST_F(CutShort, AnInjectedFaultIsOnTheSummaryScreen) {
  accept();
  ASSERT_EQ(run(two_devices, "--inject slowdown:20").code, 0);
  EXPECT_THAT(gate().output, HasSubstr("injected faults (slowdown:20)"));
  ASSERT_EQ(run(two_devices).code, 0);
  EXPECT_THAT(gate().output, Not(HasSubstr("injected")));
}

}  // namespace
}  // namespace triptych::command_line
