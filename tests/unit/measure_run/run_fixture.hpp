#pragma once
// Runs the fake suite on the null backend, in real worker processes.

#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "measure/run/runner.hpp"
#include "tests/unit/measure/fake_suite.hpp"
#include "tests/unit/measure_run/scratch.hpp"

namespace triptych::measure {

// The time limit for tests in which a worker hangs. Workers that do not hang must answer within
// this time.
inline constexpr std::chrono::seconds hang_limit{MEASURE_RUN_HANG_LIMIT_S};

class RunTest : public testing::Test {
 protected:
  RunTest() {
    options.worker_command = {MEASURE_RUN_HELPER, "worker"};
    options.limit = std::chrono::seconds(30);
  }

  [[nodiscard]] record::Store open_store() const {
    return {scratch.path() / "store.sqlite", record::Store::Mode::append};
  }

  // Returns the plan fake/quick with these levels. The other factors keep the levels of the plan.
  [[nodiscard]] Plan plan(const Overrides& overrides) {
    return load_plan("fake/quick", overrides, find());
  }
  // Returns four configurations of technique raycast with the data cube: two step sizes, each with
  // two cameras.
  [[nodiscard]] Plan small_plan() { return plan({{"technique", {"raycast"}}, {"data", {"cube"}}}); }

  RunResult run(const Plan& what, std::vector<std::string> devices = {"null:scripted"}) {
    record::Store store = open_store();
    return run_plan(what, devices, suite, store, options, [this](const Progress& progress) {
      if (progress.loading) {
        loading_reports.push_back(*progress.loading);
      } else {
        reported.push_back(progress.configuration);
      }
    });
  }

  // Returns the records of a run, sorted by device and configuration.
  [[nodiscard]] std::vector<record::Record> records(const std::string& run) const {
    return open_store().records(run);
  }

  [[nodiscard]] std::vector<pid_t> started_workers() const {
    std::ifstream lines(starts());
    std::vector<pid_t> pids;
    for (pid_t pid = 0; lines >> pid;) pids.push_back(pid);
    return pids;
  }
  [[nodiscard]] std::string starts() const { return (scratch.path() / "starts").string(); }

  [[nodiscard]] FindSuite find() {
    return [this](std::string_view) -> Suite& { return suite; };
  }

  ScratchFolder scratch;
  Variable cache_home{"XDG_CACHE_HOME", (scratch.path() / "cache").string()};
  Variable script{"TRIPTYCH_NULL_SCRIPT", R"({"base_ns": 3e6})"};
  Variable starts_file{"TRIPTYCH_TEST_STARTS", starts()};
  Variable lp_perf{"LP_PERF"};
  FakeSuite suite;
  RunOptions options;
  std::vector<std::string> reported;
  std::vector<Loading> loading_reports;
};

}  // namespace triptych::measure
