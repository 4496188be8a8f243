#include "measure/run/interleaved.hpp"

#include <cmath>
#include <csignal>

#include "tests/unit/measure_run/run_fixture.hpp"

namespace triptych::measure {
namespace {

using record::Outcome;
using ::testing::DoubleNear;
using ::testing::Each;

std::string script_with(const std::string& keys) {
  return "TRIPTYCH_NULL_SCRIPT={" + keys + "}";
}

class TurnsTest : public RunTest {
 protected:
  TurnsTest() {
    a.device = b.device = "null:scripted";
    a.command = b.command = {MEASURE_RUN_HELPER, "worker"};
  }

  [[nodiscard]] Interleaved open() const { return {options_, a, b}; }
  [[nodiscard]] Configuration configuration() { return small_plan().configurations.front(); }
  void hold(Interleaved& interleaved, const std::vector<std::string>& faults_b = {}) {
    interleaved.hold(configuration(), {std::vector<std::string>{}, faults_b}, SideClock::wall);
  }
  static std::vector<Block> blocks(Interleaved& interleaved, int count) {
    std::vector<Block> result;
    while (static_cast<int>(result.size()) < count) result.push_back(interleaved.block());
    return result;
  }

  // The two compared programs are called sides. `side` is the side whose worker ended when side b
  // measured a configuration with an injected fault.
  struct Ended {
    Side side;
    Outcome outcome;
    record::Reason reason;
  };
  std::optional<Ended> ended(Interleaved& interleaved, const std::string& fault) {
    try {
      hold(interleaved, {fault});
    } catch (const SideEnded& error) {
      return Ended{error.side(), error.outcome(), error.reason()};
    }
    return std::nullopt;
  }

  InterleavedOptions options_{.suite = "fake", .kinds = {"compute"}};
  SideOptions a;
  SideOptions b;
};

TEST_F(TurnsTest, TheDifferenceIsTheLogarithmOfTheRatio) {
  b.environment = {script_with(R"("base_ns": 3e6, "devices": [1.1])")};
  Interleaved interleaved = open();
  hold(interleaved);
  const std::vector<Block> all = blocks(interleaved, 6);
  EXPECT_EQ(interleaved.frames_per_batch(), 1);
  // A block repeats its four batches of 3 ms, two of each side, until it lasts at least 40 ms.
  EXPECT_EQ(interleaved.repetitions_per_block(), 4);
  EXPECT_THAT(differences(all, SideClock::wall), Each(DoubleNear(std::log(1.1), 1e-9)));
  EXPECT_THAT(differences(all, SideClock::device), Each(DoubleNear(std::log(1.1), 1e-9)));
  EXPECT_TRUE(device_times_plausible(all));
}

TEST_F(TurnsTest, BothOrdersOccurAndFollowFromTheSeed) {
  const auto orders = [this](std::uint64_t seed) {
    options_.seed = seed;
    Interleaved interleaved = open();
    hold(interleaved);
    std::vector<bool> result;
    for (const Block& block : blocks(interleaved, 16)) result.push_back(block.b_first);
    return result;
  };
  const std::vector<bool> first = orders(1);
  EXPECT_THAT(first, testing::Contains(true));
  EXPECT_THAT(first, testing::Contains(false));
  EXPECT_EQ(orders(1), first);
  EXPECT_NE(orders(2), first);
}

TEST_F(TurnsTest, ShortFramesAreBatchedAlikeOnBothSides) {
  a.environment = {script_with(R"("base_ns": 1e5, "ns_per_sample": 0)")};
  b.environment = {script_with(R"("base_ns": 4e5, "ns_per_sample": 0)")};
  Interleaved interleaved = open();
  hold(interleaved);
  // A batch of the faster side lasts a millisecond.
  EXPECT_EQ(interleaved.frames_per_batch(), 10);
  EXPECT_EQ(interleaved.repetitions_per_block(), 10);  // ten repetitions of four batches fill 40 ms
  const Block block = interleaved.block();
  // Times are means over the frames of a batch.
  EXPECT_NEAR(block.a.wall_ns[0], 1e5, 1);
  EXPECT_NEAR(block.b.wall_ns[1], 4e5, 1);
}

// A block measures two batches of each side, repeats them ten times, and uses the smallest time of
// each batch. Its result is wrong only if all ten repetitions of the first or of the second batch
// of b are disturbed, which has a probability of 1/85000.
TEST_F(TurnsTest, ADisturbanceOfPartOfABlockDoesNotCount) {
  a.environment = {script_with(R"("base_ns": 1e6, "ns_per_sample": 0)")};
  b.environment = {script_with(
      R"("base_ns": 1e6, "ns_per_sample": 0, "outlier_share": 0.3, "outlier_factor": 2)")};
  options_.least_batch_ns = 1;
  Interleaved interleaved = open();
  hold(interleaved);
  ASSERT_EQ(interleaved.repetitions_per_block(), 10);
  EXPECT_THAT(differences(blocks(interleaved, 12), SideClock::wall), Each(DoubleNear(0, 1e-9)));
}

TEST_F(TurnsTest, MissingAndWrongClocksAreRejected) {
  b.environment = {script_with(R"("base_ns": 3e6, "device_over_wall": null)")};
  {
    Interleaved interleaved = open();
    hold(interleaved);
    const std::vector<Block> all = blocks(interleaved, 4);
    EXPECT_FALSE(device_times_plausible(all));
    EXPECT_FALSE(all.front().b.device_ns);
    EXPECT_TRUE(all.front().a.device_ns);
  }
  b.environment = {script_with(R"("base_ns": 3e6, "device_over_wall": 0.1)")};
  Interleaved interleaved = open();
  EXPECT_FALSE(interleaved.hello(Side::b).clocks.front().trusted);
  EXPECT_TRUE(interleaved.hello(Side::a).clocks.front().trusted);
  hold(interleaved);
  EXPECT_FALSE(device_times_plausible(blocks(interleaved, 4)));
}

TEST_F(TurnsTest, ACrashAffectsOneConfigurationAndReportsItsSide) {
  Interleaved interleaved = open();
  const auto end = ended(interleaved, "crash");
  ASSERT_TRUE(end);
  EXPECT_EQ(end->side, Side::b);
  EXPECT_EQ(end->outcome, Outcome::crashed);
  EXPECT_EQ(end->reason.number("signal"), SIGSEGV);
  hold(interleaved);
  EXPECT_THAT(differences(blocks(interleaved, 2), SideClock::wall), Each(DoubleNear(0, 1e-9)));
  EXPECT_EQ(started_workers().size(), 3U);
}

TEST_F(TurnsTest, BrokenInputIsSkippedLikeInARun) {
  Interleaved interleaved = open();
  Configuration torn = configuration();
  torn["data"] = "torn";
  try {
    interleaved.hold(torn, {}, SideClock::wall);
    FAIL() << "nothing was thrown";
  } catch (const SideEnded& error) {
    EXPECT_EQ(error.outcome(), Outcome::skipped);
    EXPECT_EQ(error.reason().cause, record::Cause::bad_input);
    EXPECT_EQ(error.reason().detail, "torn:3: the file ends here");
  }
  hold(interleaved);
  EXPECT_EQ(started_workers().size(), 2U);
}

TEST_F(TurnsTest, AHangEndsAtItsTimeLimit) {
  options_.limit = hang_limit;
  Interleaved interleaved = open();
  const auto end = ended(interleaved, "hang");
  ASSERT_TRUE(end);
  EXPECT_EQ(end->outcome, Outcome::hung);
  hold(interleaved);
}

TEST_F(TurnsTest, ALostDeviceEndsItsWorker) {
  Interleaved interleaved = open();
  const auto end = ended(interleaved, "device_lost");
  ASSERT_TRUE(end);
  EXPECT_EQ(end->outcome, Outcome::lost);
  hold(interleaved);
  EXPECT_EQ(started_workers().size(), 3U);
}

TEST_F(TurnsTest, AnErrorInAFrameEndsTheBlockButNotTheWorker) {
  b.environment = {script_with(
      R"("base_ns": 3e6, "failures": [{"kind": "api_error", "at": "frame", "frame": 12, "only": "*data=*"}])")};
  options_.kinds = {};  // calibration frames would fail too
  Interleaved interleaved = open();
  hold(interleaved);
  try {
    blocks(interleaved, 12);
    FAIL() << "nothing was thrown";
  } catch (const SideEnded& error) {
    EXPECT_EQ(error.side(), Side::b);
    EXPECT_EQ(error.outcome(), Outcome::failed);
    EXPECT_EQ(error.reason().code, "NULL_ERROR");
  }
  // After a side has ended, further blocks are rejected.
  EXPECT_THROW(static_cast<void>(interleaved.block()), SideEnded);
  EXPECT_EQ(started_workers().size(), 2U);
}

TEST_F(TurnsTest, OnlyPreparedConfigurationsAreDrawn) {
  Interleaved interleaved = open();
  EXPECT_THROW(static_cast<void>(interleaved.block()), SideEnded);
  hold(interleaved);
  static_cast<void>(interleaved.block());
  interleaved.release();
  EXPECT_THROW(static_cast<void>(interleaved.block()), SideEnded);
}

TEST_F(TurnsTest, FreshProcessRunsAreNewProcesses) {
  Interleaved interleaved = open();
  hold(interleaved);
  interleaved.restart();
  EXPECT_EQ(started_workers().size(), 4U);
  EXPECT_THROW(static_cast<void>(interleaved.block()), SideEnded);
  hold(interleaved);
  EXPECT_EQ(interleaved.block().a.wall_ns, interleaved.block().b.wall_ns);
}

TEST_F(TurnsTest, AMissingDeviceIsRejectedImmediately) {
  b.device = "null:nothing";
  EXPECT_THROW(static_cast<void>(open()), record::NotMeasured);
}

TEST_F(TurnsTest, AnEnvironmentThatChangesTheWorkIsRejected) {
  b.environment = {"LP_PERF=no_tex"};
  EXPECT_THROW(static_cast<void>(open()), core::InputError);
}

TEST(TurnDifferences, ADriftThatIsLinearOverABlockCancels) {
  // A linear drift increases the logarithms of the times of four successive batches by 0, 0.1, 0.2
  // and 0.3. In addition, the logarithms are larger by 0.05 for the batches of b.
  const Block abba{.b_first = false,
                   .a = {.wall_ns = {1e6, 1e6 * std::exp(0.3)}, .device_ns = {}},
                   .b = {.wall_ns = {1e6 * std::exp(0.15), 1e6 * std::exp(0.25)}, .device_ns = {}}};
  const Block baab{.b_first = true,
                   .a = {.wall_ns = {1e6 * std::exp(0.1), 1e6 * std::exp(0.2)}, .device_ns = {}},
                   .b = {.wall_ns = {1e6 * std::exp(0.05), 1e6 * std::exp(0.35)}, .device_ns = {}}};
  EXPECT_THAT(differences(std::vector{abba, baab}, SideClock::wall), Each(DoubleNear(0.05, 1e-12)));
}

}  // namespace
}  // namespace triptych::measure
