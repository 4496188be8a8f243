#include "backends/opencl/particle_limits.hpp"

#include <gtest/gtest.h>

namespace triptych::opencl_backend {
namespace {

TEST(BinTable, HasABinForEveryTileAndCoarseTile) {
  EXPECT_EQ(bin_table(1, 1, 2).bins, 1U + 1U);
  EXPECT_EQ(bin_table(256, 128, 2).bins, 16U * 8U + 2U * 1U);
  EXPECT_EQ(bin_table(257, 129, 2).bins, 17U * 9U + 3U * 2U);
}

TEST(BinTable, ChunksDependOnTheParticlesAlone) {
  EXPECT_EQ(bin_table(512, 512, 0).chunks, 16U);
  EXPECT_EQ(bin_table(512, 512, 8191).chunks, 16U);
  EXPECT_EQ(bin_table(512, 512, 100000).chunks, 195U);
  EXPECT_EQ(bin_table(512, 512, 1000000).chunks, 512U);
  EXPECT_EQ(bin_table(2048, 2048, 1000000).chunks, 512U);
}

// The table has a count for each pair of a tile and a chunk (a range of particles). With 512
// chunks, the table for 8192×8192 pixels would need half a gigabyte, so large images must use fewer
// chunks.
TEST(BinTable, StaysSmallForLargeImages) {
  for (const int edge : {4096, 8192, 16384, 32768}) {
    const BinTable table = bin_table(edge, edge, 1000000);
    EXPECT_GE(table.chunks, 16U) << edge;
    EXPECT_LE(4 * table.words(), std::size_t{16} * 4096 * 4096 + 4 * 16 * table.bins) << edge;
  }
  EXPECT_LT(4 * bin_table(8192, 8192, 1000000).words(), std::size_t{1} << 27);
}

}  // namespace
}  // namespace triptych::opencl_backend
