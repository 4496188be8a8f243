#include "measure/rounds.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace triptych::measure {
namespace {

using record::Outcome;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

record::Record measured(std::vector<double> rounds_ns) {
  record::Record record;
  record.outcome = Outcome::measured;
  record.wall_ns = {rounds_ns.front(), rounds_ns.front()};
  record.rounds_ns = std::move(rounds_ns);
  return record;
}

TEST(Rounds, SettledIsWhoseQuietestWasSeenTwiceInThree) {
  EXPECT_FALSE(is_settled(measured({100})));
  EXPECT_FALSE(is_settled(measured({100, 100})));
  EXPECT_TRUE(is_settled(measured({101, 300, 100})));
  EXPECT_FALSE(is_settled(measured({103, 300, 100})));
  EXPECT_FALSE(is_settled(measured({103, 103, 100})));
  EXPECT_TRUE(is_settled(measured({103, 101, 100, 900})));
}

TEST(Rounds, TheGapIsThatOfTheTwoLeast) {
  EXPECT_FALSE(measured({100}).round_gap());
  EXPECT_NEAR(measured({200, 110, 100}).round_gap().value(), std::log(1.1), 1e-15);
  EXPECT_FALSE(measured({0, 0}).round_gap());
}

TEST(Rounds, TheQuietestRoundsTimesAreTheRecords) {
  record::Record record = measured({100});
  EXPECT_TRUE(add_round(record, {.reason = {}, .wall_ns = {120, 130, 110}, .device_ns = {}}));
  EXPECT_THAT(record.wall_ns, ElementsAre(100, 100));
  EXPECT_TRUE(add_round(record, {.reason = {}, .wall_ns = {80, 90, 10}, .device_ns = {}}));
  EXPECT_THAT(record.wall_ns, ElementsAre(80, 90, 10));
  EXPECT_THAT(record.rounds_ns, ElementsAre(100, 120, 80));
}

TEST(Rounds, ARecordByTheDevicesClockTakesNoOther) {
  record::Record record = measured({100e6});
  record.device_ns = {100e6, 100e6};
  record.device_clock_trusted = true;
  EXPECT_FALSE(add_round(record, {.reason = {}, .wall_ns = {50e6, 50e6}, .device_ns = {}}));
  EXPECT_FALSE(add_round(record, {.reason = {}, .wall_ns = {50e6, 50e6}, .device_ns = {1, 1}}));
  EXPECT_THAT(record.rounds_ns, ElementsAre(100e6));
  EXPECT_TRUE(
      add_round(record, {.reason = {}, .wall_ns = {52e6, 52e6}, .device_ns = {50e6, 50e6}}));
  EXPECT_THAT(record.rounds_ns, ElementsAre(100e6, 50e6));
  EXPECT_THAT(record.device_ns, ElementsAre(50e6, 50e6));
}

TEST(Rounds, TheNextRoundLeavesOutWhatIsSettledDoneOrNotMeasured) {
  std::vector<record::Record> records{measured({100, 100, 100}), measured({100, 130, 120}),
                                      measured({100, 200, 100.5}), measured({100}),
                                      measured({1, 2, 3, 4})};
  records.push_back(measured({100}));
  records.back().outcome = Outcome::crashed;
  EXPECT_THAT(next_round(records, 4, RoundOrder::as_measured), ElementsAre(1, 3));
  EXPECT_THAT(next_round(records, 1, RoundOrder::as_measured), IsEmpty());
}

TEST(Rounds, TheMostDoubtfulGoesFirstWhereAsked) {
  const std::vector<record::Record> records{measured({100, 130, 120}), measured({100, 190, 180}),
                                            measured({100}), measured({100, 150})};
  EXPECT_THAT(next_round(records, 9, RoundOrder::doubtful_first), ElementsAre(2, 1, 3, 0));
  EXPECT_THAT(next_round(records, 9, RoundOrder::as_measured), ElementsAre(0, 1, 2, 3));
}

}  // namespace
}  // namespace triptych::measure
