#pragma once
// Triptych anchors, version 1. FROZEN: this file and the device code of the anchors never change,
// so that a time measured today can be held against one measured years ago. Whoever needs other
// work adds another anchor under another name. tests/architecture/frozen_test.cpp holds their
// hashes.

#include <cstdint>

namespace triptych::technique::anchor_shape {

// All counts are for size 1; the work grows in proportion to the size.

// A work-group of the compute anchors, but anchor_launch, which has groups of one.
inline constexpr std::uint32_t group = 64;

// anchor_arithmetic: chains of x ← x·a + b in registers. Work groups, chains in all (eight to an
// invocation, in OpenCL C sixty-four, as its compilers do not all vectorise across invocations),
// turns of a loop, steps of each chain in a turn. a = b = 1, which the compiler is not told: every
// chain ends on its start plus its number of steps, exactly, whether a·x + b is fused or not.
inline constexpr std::uint32_t arithmetic_chains = 131072;
inline constexpr std::uint32_t arithmetic_groups = 256;
inline constexpr std::uint32_t arithmetic_groups_opencl = 32;
inline constexpr std::uint32_t arithmetic_turns = 64;
inline constexpr std::uint32_t arithmetic_steps_a_turn = 8;

// anchor_fetch: trilinear fetches at scattered places of a volume of fetch_edge³ floats. Places lie
// on or half-way between voxel centres and the voxels hold whole numbers below 128: every result is
// a multiple of 1/8 that any filter gets right.
inline constexpr std::uint32_t fetch_edge = 64;
inline constexpr std::uint32_t fetch_groups = 256;
inline constexpr std::uint32_t fetch_turns = 32;  // fetches per invocation

// anchor_memory: reads a stream of words and writes another. Work groups, words of each stream per
// group.
inline constexpr std::uint32_t memory_groups = 1024;
inline constexpr std::uint32_t memory_words_a_group = 4096;
inline constexpr std::uint32_t memory_key = 0x9E3779B9;

// anchor_raster: layers of right-angled triangles of 32×31 pixels, 31×31 to a layer, each layer
// shifted against the last, added up in a target of raster_edge² RGBA8 pixels. Corners lie on
// corners of pixels and no edge meets the centre of one: half of the 32·31 pixels are covered, by
// any rule.
inline constexpr std::uint32_t raster_edge = 1024;
inline constexpr std::uint32_t raster_layers = 3;
inline constexpr std::uint32_t raster_triangles_a_layer = 31 * 31;
inline constexpr std::uint32_t raster_most_layers = 255;  // a byte holds no more

// anchor_launch: launches of one invocation that adds 1 to a word.
inline constexpr std::uint32_t launches = 256;

}  // namespace triptych::technique::anchor_shape
