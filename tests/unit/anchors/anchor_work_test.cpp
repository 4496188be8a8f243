#include "technique/anchors/anchor_work.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "technique/catalogue.hpp"

namespace triptych::technique {
namespace {

std::vector<std::string> anchors() {
  std::vector<std::string> ids;
  for (const Technique& each : catalogue()) {
    if (each.suite == "anchors") ids.push_back(each.id);
  }
  return ids;
}

// What of a frame is proportional to its size.
double amount(const AnchorFrame& frame) {
  if (frame.vertices > 0) return frame.vertices;
  const double turns = frame.source_words > 0 ? 1 : std::max(1U, frame.parameters.work[0]);
  return turns * frame.groups * frame.launches;
}

TEST(AnchorWork, GrowsInProportionToTheSize) {
  ASSERT_EQ(anchors().size(), 5U);
  for (const std::string& id : anchors()) {
    const double one = amount(anchor_frame(id, 1));
    for (const int size : {2, 4, 31}) {
      EXPECT_EQ(amount(anchor_frame(id, size)), one * size) << id << ' ' << size;
    }
  }
}

TEST(AnchorWork, TheStreamsOutgrowTheCachesOfACore) {
  const AnchorFrame frame = anchor_frame("anchor_memory", 1);
  EXPECT_EQ(4 * frame.source_words, std::uint64_t{16} << 20);
  EXPECT_EQ(frame.result_words, frame.source_words);
}

TEST(AnchorWork, SizesEndWhereTheShapeDoes) {
  for (const std::string& id : anchors()) {
    EXPECT_FALSE(anchor_size_reason(id, 1)) << id;
    EXPECT_FALSE(anchor_size_reason(id, 31)) << id;
    EXPECT_TRUE(anchor_size_reason(id, 0)) << id;
    EXPECT_TRUE(anchor_size_reason(id, 1 << 20)) << id;
  }
  EXPECT_FALSE(anchor_size_reason("anchor_raster", 85));  // 255 layers
  EXPECT_EQ(anchor_size_reason("anchor_raster", 86),
            "anchor_raster has sizes from 1 to 85, not 86");
  EXPECT_TRUE(anchor_size_reason("raycast", 1));
}

TEST(AnchorWork, DataAreAsTheirTextSays) {
  const std::vector<std::uint32_t> source = anchor_source(3);
  EXPECT_EQ(source, (std::vector<std::uint32_t>{0, 2654435761U, 2654435761U * 2}));
  EXPECT_EQ(anchor_checksum({0xFFFFFFFFU, 3}), 2U);
  const std::vector<float> volume = anchor_volume();
  ASSERT_EQ(volume.size(), 64U * 64 * 64);
  EXPECT_EQ(volume[5 + 64 * (4 + 64 * 3)], static_cast<float>((7 * 5 + 13 * 4 + 29 * 3) % 128));
}

}  // namespace
}  // namespace triptych::technique
