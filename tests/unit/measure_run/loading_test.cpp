#include "measure/contract/loading.hpp"

#include <gmock/gmock.h>

#include <vector>

#include "tests/unit/measure_run/run_fixture.hpp"

namespace triptych::measure {
namespace {

using std::chrono::milliseconds;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// Reports loading progress at known times.
class PacedLoading : public testing::Test {
 protected:
  // Sends `steps` + 1 reports: the first (share 0) now, and the last (share 1) after `length`.
  void load(const std::string& what, milliseconds length, int steps) {
    for (int i = 0; i <= steps; ++i) {
      report_({.what = what, .share = static_cast<double>(i) / steps});
      if (i < steps) now_ += length / steps;
    }
  }

  void note(const std::string& what, const std::string& sentence) {
    report_({.what = what, .share = 1, .note = sentence});
  }

  std::vector<double> reported_shares;

 private:
  std::chrono::steady_clock::time_point now_{};
  OnLoading report_ =
      throttled([this](const Loading& loading) { reported_shares.push_back(loading.share); },
                [this] { return now_; });
};

TEST_F(PacedLoading, ShortLoadsAreNotReported) {
  for (int i = 0; i < 10; ++i) load("a", milliseconds(1900), 100);
  EXPECT_THAT(reported_shares, IsEmpty());
}

TEST_F(PacedLoading, LongLoadsAreReportedEveryTwoSeconds) {
  load("a", milliseconds(10'000), 100);
  EXPECT_THAT(reported_shares, ElementsAre(0.2, 0.4, 0.6, 0.8, 1));
}

TEST_F(PacedLoading, NotesAreForwardedImmediatelyAndOnce) {
  note("a", "guessed");
  note("a", "guessed");
  note("b", "guessed");
  EXPECT_THAT(reported_shares, SizeIs(2));
}

TEST_F(PacedLoading, TimeBetweenLoadsDoesNotCount) {
  load("a", milliseconds(1000), 2);
  load("b", milliseconds(1900), 2);
  load("b", milliseconds(5000), 2);
  load("b", milliseconds(1900), 2);
  EXPECT_THAT(reported_shares, ElementsAre(0.5, 1));
}

TEST_F(RunTest, SlowLoadingInAWorkerIsReported) {
  const Plan slow = plan(
      {{"technique", {"raycast"}}, {"data", {"slow"}}, {"step", {"1"}}, {"camera", {"random:7"}}});
  EXPECT_EQ(run(slow).measured, 1);
  EXPECT_THAT(loading_reports, AllOf(SizeIs(2), Each(Field(&Loading::what, "slow"))));
  EXPECT_EQ(loading_reports.at(0).share, 0.5);
  EXPECT_EQ(loading_reports.at(1).share, 1);
  EXPECT_THAT(reported, SizeIs(1));  // only the report about the configuration itself
}

TEST_F(RunTest, FastLoadingIsNotReported) {
  EXPECT_EQ(run(small_plan()).measured, 4);
  EXPECT_THAT(loading_reports, IsEmpty());
}

}  // namespace
}  // namespace triptych::measure
