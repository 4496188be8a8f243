// Tests runs that are stopped from outside and resumed by a later run.

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <set>
#include <thread>

#include "core/error.hpp"
#include "measure/system/process.hpp"
#include "tests/unit/measure_run/run_fixture.hpp"

namespace triptych::measure {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class RunResume : public RunTest {
 protected:
  // Frames really take 4 ms, so that a configuration takes about 0.15 s.
  Variable slow{"TRIPTYCH_NULL_SCRIPT", R"({"base_ns": 4e6, "sleep": true})"};

  // Starts a supervisor in a child process, which a test can kill.
  [[nodiscard]] Process supervise() const {
    std::vector<std::string> environment;
    for (char** entry = environ; *entry != nullptr; ++entry) environment.emplace_back(*entry);
    return Process({MEASURE_RUN_HELPER, "supervise", (scratch.path() / "store.sqlite").string()},
                   environment);
  }

  // Waits until the supervisor has stored `count` records.
  void wait_for_records(std::size_t count) const {
    const record::Store store = open_store();
    for (int i = 0; i < 2000; ++i) {
      const auto latest = store.latest_run("fake/quick");
      if (latest && store.records(latest->id).size() >= count) return;
      std::this_thread::sleep_for(milliseconds(10));
    }
    FAIL() << "the supervisor did not store enough records";
  }

  // Starts or resumes the run until a worker has been started for the first configuration, and then
  // kills the supervisor. The worker never answers.
  void kill_during_first_configuration(int signal) const {
    const Variable hanging_open("TRIPTYCH_NULL_SCRIPT",
                                R"({"failures": [{"kind": "hang", "at": "open"}]})");
    const std::size_t before = started_workers().size();
    Process supervisor = supervise();
    for (int i = 0; i < 500 && started_workers().size() == before; ++i) {
      std::this_thread::sleep_for(milliseconds(10));
    }
    ::kill(supervisor.pid(), signal);
    ASSERT_TRUE(supervisor.wait(seconds(5)));
    ASSERT_TRUE(open_store().records(open_store().latest_run("fake/quick")->id).empty());
  }

  void expect_workers_ended() const {
    for (const pid_t pid : started_workers()) {
      for (int i = 0; i < 300 && ::kill(pid, 0) == 0; ++i) {
        std::this_thread::sleep_for(milliseconds(10));
      }
      EXPECT_EQ(::kill(pid, 0), -1) << pid;
    }
  }
};

TEST_F(RunResume, AKilledSupervisorLosesAtMostTheConfigurationInFlight) {
  const Plan whole = load_plan("fake/quick", {}, find());
  std::size_t kept = 0;
  {
    Process supervisor = supervise();
    wait_for_records(3);
    ::kill(supervisor.pid(), SIGKILL);
    ASSERT_TRUE(supervisor.wait(seconds(5)));
    kept = open_store().records(open_store().latest_run("fake/quick")->id).size();
  }
  ASSERT_GE(kept, 3U);
  ASSERT_LT(kept, whole.configurations.size());
  expect_workers_ended();

  options.resume = true;
  const RunResult result = run(whole);
  EXPECT_EQ(static_cast<std::size_t>(result.measured), whole.configurations.size());
  EXPECT_EQ(static_cast<std::size_t>(result.already_stored), kept);
  EXPECT_EQ(reported.size(), whole.configurations.size() - kept);
  const record::Store store = open_store();
  EXPECT_EQ(store.runs().size(), 1U);
  EXPECT_EQ(store.records(result.run).size(), whole.configurations.size());
}

// Imitates a driver that crashes the machine, so that no process is left to report the crash.
TEST_F(RunResume, AConfigurationThatTwiceEndedTheRunIsSkipped) {
  kill_during_first_configuration(SIGKILL);
  kill_during_first_configuration(SIGKILL);
  options.resume = true;
  const Plan whole = load_plan("fake/quick", {}, find());
  const RunResult result = run(whole);
  EXPECT_EQ(result.failed, 1);
  EXPECT_EQ(static_cast<std::size_t>(result.measured), whole.configurations.size() - 1);
  const record::Record first = records(result.run).front();
  EXPECT_EQ(first.configuration, configuration_key(suite, whole.configurations.front()));
  EXPECT_EQ(first.outcome, record::Outcome::crashed);
  EXPECT_EQ(first.reason.cause, record::Cause::under_way);
  EXPECT_EQ(first.reason.number("times"), 2);
}

TEST_F(RunResume, OneAbnormalEndOrAnInterruptIsNotRecordedAsACrash) {
  kill_during_first_configuration(SIGKILL);
  kill_during_first_configuration(SIGTERM);
  kill_during_first_configuration(SIGTERM);
  options.resume = true;
  EXPECT_EQ(run(load_plan("fake/quick", {}, find())).failed, 0);
}

TEST_F(RunResume, ATerminatedSupervisorEndsItsWorkerAndCanBeResumed) {
  Process supervisor = supervise();
  wait_for_records(2);
  ::kill(supervisor.pid(), SIGTERM);
  const auto exit = supervisor.wait(seconds(5));
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->code, 100 + SIGTERM);  // Interrupted was thrown and caught
  expect_workers_ended();
  for (const record::Record& record : records(open_store().latest_run("fake/quick")->id)) {
    EXPECT_EQ(record.outcome, record::Outcome::measured);
  }
}

TEST_F(RunResume, AWorkerStuckInItsDriverDoesNotOutliveItsSupervisor) {
  const Variable hanging_open("TRIPTYCH_NULL_SCRIPT",
                              R"({"failures": [{"kind": "hang", "at": "open"}]})");
  Process supervisor = supervise();
  for (int i = 0; i < 500 && started_workers().empty(); ++i) {
    std::this_thread::sleep_for(milliseconds(10));
  }
  std::this_thread::sleep_for(milliseconds(200));  // by then, the worker hangs
  ::kill(supervisor.pid(), SIGKILL);
  ASSERT_TRUE(supervisor.wait(seconds(5)));
  ASSERT_EQ(started_workers().size(), 1U);
  expect_workers_ended();
}

class RunAgain : public RunTest {};

TEST_F(RunAgain, ResumingAFinishedRunMeasuresNothing) {
  const RunResult first = run(small_plan());
  options.resume = true;
  const RunResult again = run(small_plan());
  EXPECT_EQ(again.run, first.run);
  EXPECT_EQ(again.measured, 4);
  EXPECT_EQ(again.already_stored, 4);
  EXPECT_EQ(started_workers().size(), 1U);
  options.resume = false;
  EXPECT_NE(run(small_plan()).run, first.run);
}

TEST_F(RunAgain, ABuildThatResumesAnotherRunIsReported) {
  options.program = "build a";
  static_cast<void>(run(plan({{"technique", {"raycast"}}, {"data", {"cube"}}})));
  options.program = "build b";
  options.resume = true;
  static_cast<void>(run(small_plan()));
  const record::Store store = open_store();
  ASSERT_EQ(store.runs().size(), 1U);
  std::set<std::string> programs;
  for (const record::RunStart& each : store.runs()[0].begun) programs.insert(each.program);
  EXPECT_EQ(programs, (std::set<std::string>{"build a", "build b"}));
}

TEST_F(RunAgain, AChangedPlanResumesOnlyItsOwnConfigurations) {
  const RunResult first = run(plan({{"technique", {"raycast"}}, {"data", {"cube"}}}));
  options.resume = true;
  Plan larger = plan({{"technique", {"raycast"}}});
  larger.hash = "of the plan with more data";
  EXPECT_EQ(run(larger).run, first.run);
  Plan another = plan({{"technique", {"raycast"}}, {"data", {"ball"}}});
  EXPECT_EQ(run(another).run, first.run) << "a part of the same plan must resume the run";
  another.hash = "of another plan";
  EXPECT_THROW(run(another), core::InputError);
  options.resume = false;
  EXPECT_NE(run(another).run, first.run);
}

TEST_F(RunAgain, AResumedRunKeepsItsClocksAndRejectsAnotherDriver) {
  static_cast<void>(run(plan({{"technique", {"raycast"}}, {"data", {"cube"}}, {"step", {"1"}}})));
  options.resume = true;
  {
    // With this script, the device clock reports only half of the wall time. If the clock were
    // calibrated again, it would therefore not be trusted.
    const Variable wrong_clock("TRIPTYCH_NULL_SCRIPT",
                               R"({"base_ns": 3e6, "device_over_wall": 0.5})");
    const RunResult more = run(small_plan());
    EXPECT_EQ(more.measured, 4);
    EXPECT_EQ(more.already_stored, 2);
    EXPECT_TRUE(open_store().devices(more.run).at(0).clocks.at(0).trusted);
  }
  const Variable updated("TRIPTYCH_NULL_SCRIPT", R"({"base_ns": 3e6, "driver_version": "2"})");
  EXPECT_THROW(run(plan({{"technique", {"raycast"}}, {"data", {"ball"}}})), core::InputError);
}

// Several workers may share a device only if nothing is timed.
TEST_F(RunTest, WorkersOfOneDeviceShareAPlan) {
  options.jobs = 3;
  options.protocol.timed = false;
  const RunResult result = run(small_plan());
  EXPECT_EQ(result.measured, 4);
  EXPECT_EQ(records(result.run).size(), 4U);
  EXPECT_EQ(started_workers().size(), 3U);
  options.protocol.timed = true;
  EXPECT_EQ(run(small_plan()).measured, 4);
  EXPECT_EQ(started_workers().size(), 4U) << "only one worker may measure times";
}

TEST_F(RunTest, WorkersOfOneDeviceResumeARun) {
  options.jobs = 2;
  options.protocol.timed = false;
  options.faults = {{.fault = "crash", .only = "*step=0.5*"}};
  EXPECT_EQ(run(small_plan()).failed, 2);
  options.resume = true;
  const RunResult resumed = run(small_plan());
  EXPECT_EQ(resumed.already_stored, 4);
  EXPECT_EQ(resumed.measured, 2);
  EXPECT_EQ(resumed.failed, 2);
}

TEST_F(RunTest, RepeatedConfigurationsReplaceTheirRecords) {
  options.faults = {{.fault = "crash", .only = "*step=0.5*"}};
  const RunResult first = run(small_plan());
  ASSERT_EQ(first.failed, 2);
  std::string one;
  for (const record::Record& each : records(first.run)) {
    if (each.outcome == record::Outcome::crashed) one = each.configuration;
  }
  options.faults.clear();
  options.resume = true;
  options.remeasure = {{"null:scripted", one}, {"null:other", "technique=raycast"}};
  reported.clear();
  const RunResult second = run(small_plan());
  EXPECT_EQ(second.run, first.run);
  EXPECT_THAT(reported, testing::ElementsAre(one));
  EXPECT_EQ(second.measured, 3);
  EXPECT_EQ(second.failed, 1);
  EXPECT_EQ(second.already_stored, 3);
}

}  // namespace
}  // namespace triptych::measure
