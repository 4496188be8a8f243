// Tests that any failure of a worker costs only one configuration and leaves nothing behind.

#include <sys/wait.h>

#include <cerrno>
#include <csignal>
#include <filesystem>

#include "core/error.hpp"
#include "tests/unit/measure_run/run_fixture.hpp"
#include "tests/unit/measure_run/spawning.hpp"

namespace triptych::measure {
namespace {

using record::Cause;
using record::Outcome;
using ::testing::AllOf;
using ::testing::HasSubstr;

class RunFaults : public RunTest {
 protected:
  // Runs four configurations, of which the second has the fault, and returns its record. Expects
  // that the other three are measured.
  record::Record outcome_of(const std::string& fault) {
    const Plan what = small_plan();
    options.faults = {{fault, configuration_key(suite, what.configurations.at(1))}};
    const RunResult result = run(what);
    EXPECT_EQ(result.measured, 3);
    EXPECT_EQ(result.failed, 1);
    const auto all = records(result.run);
    EXPECT_EQ(all.size(), 4U);
    for (const record::Record& record : all) {
      if (!record.injected.empty()) return record;
      EXPECT_EQ(record.outcome, Outcome::measured) << record.reason.detail;
    }
    return {};
  }

  static std::size_t open_descriptors() {
    const std::filesystem::directory_iterator all("/proc/self/fd");
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
  }
};

TEST_F(RunFaults, ACrashAffectsOneConfigurationAndReportsItsSignal) {
  const record::Record record = outcome_of("crash");
  EXPECT_EQ(record.outcome, Outcome::crashed);
  EXPECT_EQ(record.reason.number("signal"), SIGSEGV);
  EXPECT_EQ(record.injected, "crash");
  EXPECT_EQ(started_workers().size(), 2U);
}

TEST_F(RunFaults, AHangAffectsOneConfiguration) {
  options.limit = hang_limit;
  const record::Record record = outcome_of("hang");
  EXPECT_EQ(record.outcome, Outcome::hung);
  EXPECT_EQ(record.reason.limit(), std::chrono::ceil<std::chrono::seconds>(hang_limit));
  EXPECT_EQ(started_workers().size(), 2U);
}

TEST_F(RunFaults, ALostDeviceAffectsOneConfigurationAndItsWorker) {
  const record::Record record = outcome_of("device_lost");
  EXPECT_EQ(record.outcome, Outcome::lost);
  EXPECT_EQ(started_workers().size(), 2U);
}

TEST_F(RunFaults, AnApiErrorAffectsOneConfigurationButNotItsWorker) {
  const Variable failing(
      "TRIPTYCH_NULL_SCRIPT",
      R"({"base_ns": 3e6, "failures": [{"kind": "api_error", "at": "frame", "frame": 6, "only": "*data=cube*step=0.5*"}]})");
  const RunResult result = run(small_plan());
  EXPECT_EQ(result.measured, 2);
  EXPECT_EQ(result.failed, 2);
  EXPECT_EQ(started_workers().size(), 1U);
  for (const record::Record& record : records(result.run)) {
    if (record.outcome == Outcome::measured) continue;
    EXPECT_EQ(record.outcome, Outcome::failed);
    EXPECT_EQ(record.reason.cause, Cause::api_error);
    EXPECT_EQ(record.reason.subject, "null_frame");
    EXPECT_EQ(record.reason.code, "NULL_ERROR");
    EXPECT_TRUE(record.wall_ns.empty());
  }
}

TEST_F(RunFaults, ABrokenFileIsNotAttributedToTheDevice) {
  const Plan torn = plan({{"technique", {"raycast"}},
                          {"data", {"torn", "cube"}},
                          {"step", {"1"}},
                          {"camera", {"random:7"}}});
  const RunResult result = run(torn);
  EXPECT_EQ(result.measured, 1);
  EXPECT_EQ(result.skipped, 1);
  EXPECT_EQ(started_workers().size(), 1U);
  for (const record::Record& record : records(result.run)) {
    if (record.outcome == Outcome::measured) continue;
    EXPECT_EQ(record.outcome, Outcome::skipped);
    EXPECT_EQ(record.reason.cause, Cause::bad_input);
    EXPECT_EQ(record.reason.detail, "torn:3: the file ends here");
  }
}

TEST_F(RunFaults, DataThatNeedTooMuchMemoryAreReported) {
  const RunResult result = run(plan(
      {{"technique", {"raycast"}}, {"data", {"huge"}}, {"step", {"1"}}, {"camera", {"random:7"}}}));
  EXPECT_EQ(result.failed, 1);
  const record::Reason reason = records(result.run).front().reason;
  EXPECT_EQ(reason.cause, Cause::out_of_memory);
  EXPECT_EQ(reason.subject, "huge");
}

TEST_F(RunFaults, AWorkerThatExitsCountsAsCrashed) {
  const Variable leaving(
      "TRIPTYCH_NULL_SCRIPT",
      R"({"base_ns": 3e6, "failures": [{"kind": "exit", "at": "prepare", "only": "*data=cube*step=0.5*"}]})");
  const RunResult result = run(small_plan());
  EXPECT_EQ(result.measured, 2);
  for (const record::Record& record : records(result.run)) {
    if (record.outcome == Outcome::measured) continue;
    EXPECT_EQ(record.outcome, Outcome::crashed);
    EXPECT_EQ(record.reason.cause, Cause::exit_code);
    EXPECT_EQ(record.reason.number("exit_code"), 0);
  }
}

TEST_F(RunFaults, ADeviceThatCannotBeOpenedIsGivenUpAfterTwoStarts) {
  const Variable closed("TRIPTYCH_NULL_SCRIPT",
                        R"({"failures": [{"kind": "api_error", "at": "open"}]})");
  const RunResult result = run(small_plan());
  EXPECT_EQ(result.failed, 4);
  EXPECT_EQ(started_workers().size(), 2U);
  for (const record::Record& record : records(result.run)) {
    EXPECT_EQ(record.outcome, Outcome::failed);
    EXPECT_EQ(record.reason.stage, record::Stage::opening);
    EXPECT_EQ(record.reason.code, "NULL_ERROR");
  }
}

TEST_F(RunFaults, AnUnsupportedDeviceSkipsEverythingAfterOneStart) {
  const Variable closed("TRIPTYCH_NULL_SCRIPT",
                        R"({"failures": [{"kind": "not_supported", "at": "open"}]})");
  const RunResult result = run(small_plan());
  EXPECT_EQ(result.skipped, 4);
  EXPECT_EQ(started_workers().size(), 1U);
  const record::Reason reason = records(result.run).front().reason;
  EXPECT_EQ(reason.stage, record::Stage::opening);
  EXPECT_EQ(reason.cause, Cause::not_supported);
}

TEST_F(RunFaults, AStartThatFailsOnceIsRepeated) {
  const Variable once("TRIPTYCH_TEST_FAILING_STARTS", "1");
  const RunResult result = run(small_plan());
  EXPECT_EQ(result.measured, 4);
  EXPECT_EQ(started_workers().size(), 2U);
}

TEST_F(RunFaults, AKilledCommandIsReportedWithItsSignalAndLastOutput) {
  options.worker_command = {"/bin/sh", "-c",
                            "echo first; echo cannot map device >&2; kill -BUS $$"};
  const RunResult result = run(small_plan());
  EXPECT_EQ(result.failed, 4);
  const record::Reason reason = records(result.run).front().reason;
  EXPECT_EQ(reason.number("signal"), SIGBUS);
  EXPECT_EQ(reason.last_output, "first | cannot map device");
}

TEST_F(RunFaults, AMissingCommandFailsEverythingWithTheReason) {
  if (!spawning_reports_a_missing_program()) GTEST_SKIP() << spawning_does_not_report;
  options.worker_command = {"/nowhere/triptych"};
  const RunResult result = run(small_plan());
  EXPECT_EQ(result.failed, 4);
  const record::Reason reason = records(result.run).front().reason;
  EXPECT_EQ(reason.cause, Cause::cannot_start);
  EXPECT_THAT(reason.detail, HasSubstr("/nowhere/triptych"));
}

TEST_F(RunFaults, AWorkerThatHangsWhileStartingIsGivenUp) {
  const Variable hanging("TRIPTYCH_NULL_SCRIPT",
                         R"({"failures": [{"kind": "hang", "at": "open"}]})");
  options.start_limit = hang_limit;
  const RunResult result = run(small_plan());
  EXPECT_EQ(result.failed, 4);
  const record::Reason reason = records(result.run).front().reason;
  EXPECT_EQ(reason.stage, record::Stage::opening);
  EXPECT_EQ(reason.limit(), std::chrono::ceil<std::chrono::seconds>(hang_limit));
}

TEST_F(RunFaults, AReplacementWorkerUsesTheSameClocks) {
  static_cast<void>(outcome_of("crash"));
  const record::Store store = open_store();
  const auto run_id = store.latest_run("fake/quick")->id;
  ASSERT_EQ(store.devices(run_id).size(), 1U);
  for (const record::Record& record : store.records(run_id)) {
    if (record.outcome == Outcome::measured) {
      EXPECT_EQ(record.clock(), "device");
    }
  }
}

TEST_F(RunFaults, LeavesNoDescriptorsOrZombies) {
  const std::size_t before = open_descriptors();
  options.limit = hang_limit;
  options.faults = {{"crash", "*camera=random:7*"}, {"hang", "*camera=orbit_y:1/8*step=0.5*"}};
  const RunResult result = run(small_plan());
  EXPECT_EQ(result.measured, 1);
  EXPECT_EQ(result.failed, 3);
  EXPECT_EQ(open_descriptors(), before);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
  for (const pid_t pid : started_workers()) EXPECT_EQ(::kill(pid, 0), -1) << pid;
}

}  // namespace
}  // namespace triptych::measure
