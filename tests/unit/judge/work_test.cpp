#include "judge/baselines/work.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace triptych::judge {
namespace {

std::optional<WorkChange> change(const record::Counts& now, const record::Counts& before) {
  return work_change(now, before);
}

TEST(Work, UsesTheFirstUnitThatBothHave) {
  const auto samples = change({{"samples", 110}, {"fragments", 5}}, {{"samples", 100}});
  ASSERT_TRUE(samples);
  EXPECT_EQ(samples->unit, "samples");
  EXPECT_NEAR(samples->log_ratio, std::log(1.1), 1e-12);
  EXPECT_EQ(change({{"samples", 1}, {"fragments", 2}}, {{"fragments", 2}})->unit, "fragments");
}

TEST(Work, IsUnknownIfMissingOrZero) {
  EXPECT_FALSE(change({}, {{"samples", 1}}));
  EXPECT_FALSE(change({{"samples", 1}}, {}));
  EXPECT_FALSE(change({{"samples", 0}}, {{"samples", 1}}));
  EXPECT_FALSE(change({{"samples", 1}}, {{"samples", 0}}));
}

}  // namespace
}  // namespace triptych::judge
