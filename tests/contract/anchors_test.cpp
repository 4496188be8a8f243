// The anchors leave behind what is known: sums computed here by themselves, from what the docs say
// of each anchor and not from its code.

#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "core/error.hpp"
#include "technique/catalogue.hpp"
#include "under_test.hpp"

namespace triptych::contract {
namespace {

measure::Work anchor(const std::string& technique, int size) {
  return {.technique = technique, .scene = measure::AnchorWork{.size = size}};
}

// 131072 chains that begin with their number modulo 256 and go up by one 512 times per size.
std::uint32_t arithmetic_sum(std::uint32_t size) {
  std::uint32_t sum = 0;
  for (std::uint32_t chain = 0; chain < 131072; ++chain) sum += chain % 256 + 512 * size;
  return sum;
}

// The volume at a place in half voxels from the first voxel's centre, times eight: the mean of two
// voxels along each axis on which the place lies between two, clamped at the last.
std::uint32_t eightfold_voxel(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  const auto ends = [](std::uint32_t at) {
    const std::uint32_t low = at / 2;
    const std::uint32_t high = at % 2 == 0 ? low : std::min(low + 1, 63U);
    return std::array{low, high};
  };
  std::uint32_t sum = 0;
  for (const std::uint32_t k : ends(z)) {
    for (const std::uint32_t j : ends(y)) {
      for (const std::uint32_t i : ends(x)) sum += (7 * i + 13 * j + 29 * k) % 128;
    }
  }
  return sum;
}

// 16384 walkers of 32 fetches per size, each place taken from the top bits of a generator's state.
std::uint32_t fetch_sum(std::uint32_t size) {
  std::uint32_t sum = 0;
  for (std::uint32_t walker = 0; walker < 16384; ++walker) {
    std::uint32_t state = walker * 2654435761U + 1;
    for (std::uint32_t fetch = 0; fetch < 32 * size; ++fetch) {
      state = state * 1664525U + 1013904223U;
      sum += eightfold_voxel(state >> 11 & 127, state >> 18 & 127, state >> 25 & 127);
    }
  }
  return sum;
}

// 4 Mi words per size, word i being i·2654435761 with the key's bits turned over.
std::uint32_t memory_sum(std::uint32_t size) {
  std::uint32_t sum = 0;
  for (std::uint32_t i = 0; i < 4 * 1024 * 1024 * size; ++i) sum += i * 2654435761U ^ 0x9E3779B9U;
  return sum;
}

// Three layers per size of 31·31 halves of 32·31 pixels.
std::uint32_t raster_sum(std::uint32_t size) {
  return 3 * size * 31 * 31 * (32 * 31 / 2);
}

std::uint32_t launch_sum(std::uint32_t size) {
  return 256 * size;
}

using Answer = std::uint32_t (*)(std::uint32_t size);
const std::map<std::string, Answer> answers{{"anchor_arithmetic", &arithmetic_sum},
                                            {"anchor_fetch", &fetch_sum},
                                            {"anchor_memory", &memory_sum},
                                            {"anchor_raster", &raster_sum},
                                            {"anchor_launch", &launch_sum}};

TEST(Anchors, EachHasAnAnswer) {
  for (const technique::Technique& each : technique::catalogue()) {
    if (each.suite != "anchors") continue;
    EXPECT_TRUE(answers.contains(each.id)) << each.id;
  }
}

TEST(Anchors, EveryFrameLeavesItsKnownAnswer) {
  on_every_device([](measure::Device& device) {
    int measured = 0;
    for (const auto& [technique, answer] : answers) {
      for (const int size : {1, 2, 3}) {
        SCOPED_TRACE(technique + " " + std::to_string(size));
        const measure::Work work = anchor(technique, size);
        if (device.unsupported(work)) continue;
        const auto prepared = device.prepare(work);
        static_cast<void>(prepared->frame(measure::Purpose::timing));
        const record::Counts counts = prepared->frame(measure::Purpose::counters).counts;
        EXPECT_EQ(counts, (record::Counts{{"checksum", answer(static_cast<std::uint32_t>(size))}}));
        EXPECT_EQ(prepared->frame(measure::Purpose::counters).counts, counts) << "the second time";
        ++measured;
      }
    }
    EXPECT_GE(measured, 3 * 4) << "an API lacks one anchor at most";
  });
}

TEST(Anchors, AFrameIsTimedAndHasNoPicture) {
  on_every_device([](measure::Device& device) {
    const auto prepared = device.prepare(anchor("anchor_launch", 1));
    const measure::Frame frame = prepared->frame(measure::Purpose::timing);
    EXPECT_GT(frame.wall_ns, 0);
    EXPECT_TRUE(frame.counts.empty());
    EXPECT_EQ(prepared->image().pixel_count(), 0U);
    EXPECT_FALSE(prepared->kernel_hash().empty());
  });
}

TEST(Anchors, WhatIsNoSizeOrNoAnchorIsRefusedWithTheReason) {
  on_every_device([](measure::Device& device) {
    const auto too_large = device.unsupported(anchor("anchor_memory", 64));
    ASSERT_TRUE(too_large);
    EXPECT_NE(too_large->find("1 to 63, not 64"), std::string::npos) << *too_large;
    EXPECT_TRUE(device.unsupported(anchor("anchor_launch", 0)));
    EXPECT_TRUE(device.unsupported(anchor("raycast", 1)));
    EXPECT_TRUE(device.unsupported(anchor("tiles", 1)));
    EXPECT_THROW(static_cast<void>(device.prepare(anchor("anchor_launch", 0))), core::NotSupported);
  });
}

}  // namespace
}  // namespace triptych::contract
