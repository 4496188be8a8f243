#include "measure/rounds.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <utility>

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

TEST(Rounds, SettledIsWhoseQuietestWasSeenTwiceInFour) {
  EXPECT_FALSE(is_settled(measured({100})));
  EXPECT_FALSE(is_settled(measured({100, 100, 100})));
  EXPECT_TRUE(is_settled(measured({101, 300, 100, 200})));
  EXPECT_FALSE(is_settled(measured({103, 300, 100, 200})));
  EXPECT_FALSE(is_settled(measured({103, 103, 103, 100})));
  EXPECT_TRUE(is_settled(measured({103, 101, 100, 900, 900})));
}

TEST(Rounds, TheGapIsThatOfTheTwoLeast) {
  EXPECT_FALSE(measured({100}).round_gap());
  EXPECT_NEAR(measured({200, 110, 100}).round_gap().value(), std::log(1.1), 1e-15);
  EXPECT_FALSE(measured({0, 0}).round_gap());
}

Turn pass(std::vector<double> wall_ns, std::vector<double> device_ns = {}) {
  return {.reason = {}, .wall_ns = std::move(wall_ns), .device_ns = std::move(device_ns)};
}

TEST(Rounds, TheQuietestPassesTimesAreTheRecords) {
  record::Record record = measured({100});
  EXPECT_TRUE(add_round(record, std::array{pass({120, 130, 110}), pass({400, 400, 400})}));
  EXPECT_THAT(record.wall_ns, ElementsAre(100, 100));
  EXPECT_TRUE(add_round(record, std::array{pass({90, 90, 90}), pass({80, 90, 10}), pass({95})}));
  EXPECT_THAT(record.wall_ns, ElementsAre(80, 90, 10));
  EXPECT_THAT(record.rounds_ns, ElementsAre(100, 120, 80));
  EXPECT_FALSE(add_round(record, {}));
}

TEST(Rounds, ARecordByTheDevicesClockTakesNoOther) {
  record::Record record = measured({100e6});
  record.device_ns = {100e6, 100e6};
  record.device_clock_trusted = true;
  const Turn without = pass({50e6, 50e6});
  const Turn lying = pass({50e6, 50e6}, {1, 1});
  EXPECT_FALSE(add_round(record, std::array{without, lying}));
  EXPECT_FALSE(median_by_clock(record, lying));
  EXPECT_THAT(record.rounds_ns, ElementsAre(100e6));
  const Turn told = pass({52e6, 52e6}, {50e6, 50e6});
  EXPECT_TRUE(add_round(record, std::array{without, told, lying}));
  EXPECT_THAT(record.rounds_ns, ElementsAre(100e6, 50e6));
  EXPECT_THAT(record.device_ns, ElementsAre(50e6, 50e6));
}

TEST(Rounds, APassAsFastAsTheFastestRoundSeesItAgain) {
  const record::Record record = measured({300, 100});
  EXPECT_TRUE(sees_again(record, pass({101.5, 500, 20})));
  EXPECT_TRUE(sees_again(record, pass({98.5})));
  EXPECT_FALSE(sees_again(record, pass({103})));
  EXPECT_FALSE(sees_again(record, pass({97})));  // the first to be so fast
  EXPECT_FALSE(sees_again(record, pass({})));
}

TEST(Rounds, TheNextRoundLeavesOutWhatIsSettledDoneOrNotMeasured) {
  std::vector<record::Record> records{measured({100, 100, 100, 100}), measured({100, 130, 120}),
                                      measured({100, 200, 100.5, 300}), measured({100}),
                                      measured({1, 2, 3, 4, 5})};
  records.push_back(measured({100}));
  records.back().outcome = Outcome::crashed;
  EXPECT_THAT(next_round(records, 5, RoundOrder::as_measured), ElementsAre(1, 3));
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
