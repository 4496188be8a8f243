#include "judge/gate/anchor_run.hpp"

#include <gtest/gtest.h>

namespace triptych::judge {
namespace {

const std::set<std::string> runs{"20260301T100000Z-aa", "20260301T110000Z-bb",
                                 "20260302T000500Z-cc"};

TEST(AnchorsBeside, TheLatestBeforeTheRun) {
  EXPECT_EQ(anchors_beside("20260301T105959Z-01", runs), "20260301T100000Z-aa");
  EXPECT_EQ(anchors_beside("20260301T112000Z-01", runs), "20260301T110000Z-bb");
  EXPECT_EQ(anchors_beside("20260302T010000Z-01", runs), "20260302T000500Z-cc");
}

TEST(AnchorsBeside, NoneThatIsLaterOrLongPast) {
  EXPECT_EQ(anchors_beside("20260301T095959Z-01", runs), std::nullopt);
  EXPECT_EQ(anchors_beside("20260301T120001Z-01", runs), std::nullopt);
  EXPECT_EQ(anchors_beside("20260302T000000Z-01", runs), std::nullopt);
  EXPECT_EQ(anchors_beside("20260301T105959Z-01", {}), std::nullopt);
}

// Ids that do not tell a time are only put in order.
TEST(AnchorsBeside, OtherIdsByTheirOrder) {
  EXPECT_EQ(anchors_beside("1-run", {"1-anchors", "2-anchors"}), "1-anchors");
}

}  // namespace
}  // namespace triptych::judge
