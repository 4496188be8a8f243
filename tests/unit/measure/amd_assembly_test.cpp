// Compares the instruction counts of a disassembly with manual counts.

#include "measure/code/amd_assembly.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

namespace triptych::measure {
namespace {

std::string fixture(const std::string& name) {
  std::ifstream file(std::string(TRIPTYCH_ASSEMBLY_FOLDER) + "/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The expected numbers were counted by hand in the loop of block BB94 in
// tests/unit/measure/assembly/raycast_navi21.s.
TEST(AmdAssembly, TheSamplingLoopOfNavi21MatchesACountByHand) {
  const auto counts = count_amd_instructions(fixture("raycast_navi21.s"));
  ASSERT_TRUE(counts && counts->sampling_loop);
  const InstructionCounts& loop = *counts->sampling_loop;
  // Vector instructions: v_cmpx; 8 before the volume is sampled; 9 to find the table entry of the
  // value; 3 others; 8 to interpolate the table; 5 and 5 to composite; v_cmp and 2 v_cndmask to end
  // the ray.
  EXPECT_EQ(loop.vector, 1 + 8 + 9 + 3 + 8 + 5 + 5 + 3);
  // Scalar instructions: s_mov; s_and, s_or, s_andn2; s_mov; s_mov; s_and, s_andn2, s_or.
  EXPECT_EQ(loop.scalar, 1 + 3 + 1 + 1 + 3);
  EXPECT_EQ(loop.memory, 3 + 1 + 2);  // s_load of descriptors, image_sample, image_load
  EXPECT_EQ(loop.branch, 4);          // execz, scc1, the loop exit, and the jump back
  EXPECT_EQ(loop.wait, 2 + 3);        // s_clause, s_waitcnt
  EXPECT_EQ(loop.fetches, 3);
  EXPECT_EQ(loop.all(), 66);
}

TEST(AmdAssembly, TheSamplingLoopOfVega10MatchesACountByHand) {
  const auto counts = count_amd_instructions(fixture("raycast_vega10.s"));
  ASSERT_TRUE(counts && counts->sampling_loop);
  const InstructionCounts& loop = *counts->sampling_loop;
  // Vector instructions: v_cmp; 8 before the volume is sampled; v_mov; 3 and 6 to find the table
  // entry of the value; 4 for coordinates; 3 others; 8 to interpolate the table; 5 and 5 to
  // composite; v_cmp and 2 v_cndmask to end the ray.
  EXPECT_EQ(loop.vector, 1 + 8 + 1 + 3 + 6 + 4 + 3 + 8 + 5 + 5 + 3);
  EXPECT_EQ(loop.scalar, 1 + 3 + 1 + 1 + 2 + 3);
  EXPECT_EQ(loop.memory, 3 + 1 + 2);
  EXPECT_EQ(loop.branch, 4);
  EXPECT_EQ(loop.wait, 3);
  EXPECT_EQ(loop.fetches, 3);
  EXPECT_EQ(loop.all(), 71);
}

TEST(AmdAssembly, OneMoreInstructionInTheLoopCounts) {
  std::string text = fixture("raycast_navi21.s");
  const std::size_t at = text.find("\tv_cvt_f32_i32_e32 v35, v29");
  ASSERT_NE(at, std::string::npos);
  text.insert(at, "\tv_mul_f32_e32 v35, v35, v35\n");
  EXPECT_EQ(count_amd_instructions(text)->sampling_loop->vector, 43);
}

// Other loops of the shader read bricks of the volume from a buffer. They must not be mistaken for
// the sampling loop.
TEST(AmdAssembly, ALoopWithASamplerIsPreferred) {
  const auto counts = count_amd_instructions(
      "BB0:\n\tv_mov_b32 v0, 0\nBB1:\n\tbuffer_load_dword v1, v0, s[0:3], 0\n"
      "\ts_cbranch_scc1 BB1\nBB2:\n\timage_sample v1, v[0:2], s[0:7], s[8:11]\n"
      "\ts_cbranch_scc1 BB2\n\ts_endpgm\n");
  ASSERT_TRUE(counts && counts->sampling_loop);
  EXPECT_EQ(counts->sampling_loop->all(), 2);
}

TEST(AmdAssembly, TwoSamplingLoopsAreAmbiguous) {
  const std::string loop = "\timage_sample v1, v[0:2], s[0:7], s[8:11]\n\ts_cbranch_scc1 ";
  const auto counts =
      count_amd_instructions("BB1:\n" + loop + "BB1\nBB2:\n" + loop + "BB2\n\ts_endpgm\n");
  ASSERT_TRUE(counts);
  EXPECT_FALSE(counts->sampling_loop);
  EXPECT_EQ(counts->sampling_loops, 2);
}

// The blocks have names as in LLVM's output. The sampling loop is nested in an outer loop, which
// must not be counted.
TEST(AmdAssembly, TheInnermostLoopCounts) {
  const auto counts = count_amd_instructions(
      "main:\nBB0_1:\n\ts_mov_b32 s0, 1 ; BE800301\nBB0_2:\n"
      "\timage_load v1, v0, s[0:7]\n\ts_cbranch_scc1 .LBB0_2\n\ts_branch .LBB0_1\n\ts_endpgm\n");
  ASSERT_TRUE(counts && counts->sampling_loop);
  EXPECT_EQ(counts->sampling_loop->all(), 2);
  EXPECT_EQ(counts->all.all(), 5);
}

TEST(AmdAssembly, OtherLanguagesAreNotParsed) {
  EXPECT_FALSE(count_amd_instructions("MOV R1, c[0x0][0x28] ;\nEXIT ;\n"));
  EXPECT_FALSE(count_amd_instructions(""));
}

}  // namespace
}  // namespace triptych::measure
