#pragma once
// The anchors' work, from their frozen shape: what a backend launches and what it gives to the
// device code.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::technique {

// The uniform block of the compute anchors (std140) and the first two arguments of their kernels.
struct AnchorParameters {
  std::array<std::uint32_t, 4> work{};
  std::array<float, 4> numbers{};
};
static_assert(sizeof(AnchorParameters) == 32);

// Their bindings: a uniform block, storage blocks, a texture.
inline constexpr std::uint32_t anchor_parameters_binding = 0;
inline constexpr std::uint32_t anchor_results_binding = 1;
inline constexpr std::uint32_t anchor_source_binding = 2;
inline constexpr std::uint32_t anchor_volume_binding = 3;

// The counter that every anchor has: the sum of all words that it left behind (anchor_raster: of
// the red bytes of its target), modulo 2³². Its right value is known; see docs/how-we-measure.md.
inline constexpr std::string_view anchor_counter = "checksum";

// One frame of an anchor. Of anchor_raster only the number of vertices counts.
struct AnchorFrame {
  AnchorParameters parameters;
  std::uint32_t groups = 1;
  std::uint32_t launches = 1;
  std::uint64_t result_words = 1;
  std::uint64_t source_words = 0;  // of the stream that is read; 0: there is none
  bool fetches = false;            // needs the volume
  std::uint32_t vertices = 0;      // of the triangles that are drawn
};

// `size` ≥ 1 is how many times the work of size 1. Precondition: no anchor_size_reason.
[[nodiscard]] AnchorFrame anchor_frame(std::string_view technique, int size);

// Why the shape of an anchor does not hold this size on any device, with both numbers: a group
// count that not every API has to take, a byte that would overflow. Empty when it does.
[[nodiscard]] std::optional<std::string> anchor_size_reason(std::string_view technique, int size);

// Word i of the stream that anchor_memory reads is i·2654435761 modulo 2³².
[[nodiscard]] std::vector<std::uint32_t> anchor_source(std::uint64_t words);
// The volume of anchor_fetch, x fastest: (7x + 13y + 29z) modulo 128.
[[nodiscard]] std::vector<float> anchor_volume();

// Sum modulo 2³².
[[nodiscard]] std::uint32_t anchor_checksum(const std::vector<std::uint32_t>& words);

}  // namespace triptych::technique
