#include "reduction/sequence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/random.hpp"

namespace triptych::reduction {
namespace {

// Returns the result for a frame that fails after all configurations in `needed`. Checks that no
// sequence is tried twice.
std::optional<Sequence> search(std::size_t count, const std::set<std::size_t>& needed,
                               std::size_t most_frames, std::size_t& frames) {
  std::set<Positions> tried;
  frames = 0;
  const FailsAfter fails_after = [&](const Positions& before) {
    EXPECT_TRUE(tried.insert(before).second);
    EXPECT_TRUE(std::ranges::is_sorted(before));
    frames += before.size() + 1;
    return std::ranges::includes(before, needed);
  };
  return shortest_sequence(count, most_frames, fails_after, [](std::size_t) {});
}

TEST(ShortestSequence, FindsExactlyTheConfigurationsThatAreNeeded) {
  core::Random random(5);
  for (int round = 0; round < 300; ++round) {
    const auto count = 1 + static_cast<std::size_t>(random.uniform() * 60);
    std::set<std::size_t> needed;
    const int number = 1 + static_cast<int>(random.uniform() * 4);
    for (int i = 0; i < number; ++i) {
      needed.insert(static_cast<std::size_t>(random.uniform() * static_cast<double>(count)));
    }
    std::size_t frames = 0;
    const auto found = search(count, needed, 1000000, frames);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->complete);
    EXPECT_EQ(found->before, Positions(needed.begin(), needed.end()));
  }
}

// The search tries the last 1, 2, 4, … of the n configurations, which draws at most 2n of them in
// total. Then it halves the sequence repeatedly, which draws at most another 2n. Each try also
// draws the failing frame, but there are at most about 3·log₂ n + 1 tries, so the total stays below
// 5n frames.
TEST(ShortestSequence, ASingleCulpritIsFoundWithFewFrames) {
  constexpr std::size_t count = 1000;
  for (const std::size_t needed : {std::size_t{0}, count / 2, count - 1}) {
    std::size_t frames = 0;
    const auto found = search(count, {needed}, 1000000, frames);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->before, Positions{needed});
    EXPECT_LE(frames, 5 * count) << needed;
  }
}

TEST(ShortestSequence, NothingIsFoundIfTheFrameDoesNotFail) {
  std::size_t frames = 0;
  EXPECT_FALSE(search(10, {10}, 1000000, frames));
  EXPECT_FALSE(search(0, {0}, 1000000, frames));
}

TEST(ShortestSequence, TheWholeListIsTriedEvenBeyondTheLimit) {
  std::size_t frames = 0;
  const auto found = search(10, {0}, 1, frames);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->complete);
  EXPECT_EQ(found->before.size(), 10U);
  EXPECT_EQ(frames, 11U);
}

}  // namespace
}  // namespace triptych::reduction
