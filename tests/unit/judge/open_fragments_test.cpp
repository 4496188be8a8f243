#include "judge/gate/open_fragments.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace triptych::judge {
namespace {

record::Record record_of(std::uint64_t sprites, std::uint64_t fragments, double bits) {
  record::Record record;
  record.counters = {{"sprites", sprites}, {"fragments", fragments}, {"visible_ids", sprites}};
  record.factors = {{"ray", "pixel"}};
  record.precision = {{"sub_pixel_bits", bits}};
  return record;
}

// Open fragments are those that one correct driver may draw and another may not. With a rasterizer
// grid of 1/256 pixel, an edge may differ by δ = 1/128 pixel between two drivers. The edges of 100
// squares of 10 × 10 pixels have a total length of 4,000 pixels, so 4000·δ fragments are open on
// average. The variance is 4·10000·δ for the 10,000 fragments of the squares, and five standard
// deviations are added to the average.
TEST(OpenFragments, AreThoseAlongTheEdges) {
  const record::Record record = record_of(100, 10000, 8);
  const double fluctuation = 5 * std::sqrt(4 * 10000 / 128.0);
  EXPECT_NEAR(open_fragments("fragments", record), 4000 / 128.0 + fluctuation, 0.1);
  EXPECT_EQ(open_fragments("fragments_discarded", record), open_fragments("fragments", record));
  for (const char* other : {"sprites", "vertices", "samples", "visible_ids", "fragments_kept"}) {
    EXPECT_EQ(open_fragments(other, record), 0) << other;
  }
}

TEST(OpenFragments, OfRaysFromVerticesAreThoseAlongTheSilhouetteToo) {
  record::Record record = record_of(100, 10000, 8);
  record.factors["ray"] = "vertex";
  EXPECT_GT(open_fragments("fragments_kept", record), 0);
  EXPECT_GT(open_fragments("visible_ids", record), 0);
}

TEST(OpenFragments, AreMoreOnACoarseGridAndWhereSpritesLieTogether) {
  const record::Record fine = record_of(100, 10000, 8);
  EXPECT_GT(open_fragments("fragments", record_of(100, 10000, 4)),
            5 * open_fragments("fragments", fine));
  record::Record points = fine;  // NVIDIA's driver has a point margin of 1/16 pixel
  points.precision["point_margin"] = 1.0 / 16;
  EXPECT_GT(open_fragments("fragments", points), 4000 / 16.0 + open_fragments("fragments", fine));
  record::Record together = fine;
  together.counters["visible_ids"] = 4;
  EXPECT_GT(open_fragments("fragments", together), open_fragments("fragments", fine));
  record::Record nothing = fine;
  nothing.counters.clear();
  EXPECT_EQ(open_fragments("fragments", nothing), 0);
}

}  // namespace
}  // namespace triptych::judge
