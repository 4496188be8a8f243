#pragma once
// The shape of the hierarchy that `bvh` builds on the device (hierarchy.glsl explains it).

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "technique/particles/arrangement.hpp"

namespace triptych::technique {

// The parameters of every kernel that builds or traverses the hierarchy. `step` differs from pass
// to pass.
struct HierarchyParameters {
  std::array<float, 4> origin{};         // where the curve's grid begins; w: cells per unit
  std::array<std::uint32_t, 4> shape{};  // particles, levels, particles of a leaf, larger leaves
  std::array<std::uint32_t, 4> step{};
};
static_assert(sizeof(HierarchyParameters) == std::size_t{3} * 16);

class Hierarchy {
 public:
  explicit Hierarchy(const Arrangement& arrangement);
  // With so many particles, whose centres lie in a cube of this edge.
  Hierarchy(std::uint32_t particles, const std::array<float, 3>& low, float edge);

  [[nodiscard]] const HierarchyParameters& parameters() const noexcept { return parameters_; }
  [[nodiscard]] HierarchyParameters with_step(const std::array<std::uint32_t, 4>& step) const {
    HierarchyParameters changed = parameters_;
    changed.step = step;
    return changed;
  }

  [[nodiscard]] std::uint32_t particles() const noexcept { return parameters_.shape[0]; }
  // Below the root; 0 where the root is the only leaf.
  [[nodiscard]] std::uint32_t levels() const noexcept { return parameters_.shape[1]; }
  [[nodiscard]] std::uint32_t leaves() const noexcept { return std::uint32_t{1} << levels(); }
  // Where the leaf's run of particles begins.
  [[nodiscard]] std::uint32_t leaf_begin(std::uint32_t leaf) const noexcept;
  // Runs of particles that are sorted by one invocation each. No more than 1,024, so that the loop
  // over their counts ends before Mesa ends it (technique/volume/long_rays.hpp).
  [[nodiscard]] std::uint32_t runs() const noexcept;

  // Words of the buffers, at least 4 each, as an empty one is an error everywhere.
  [[nodiscard]] std::size_t box_words() const noexcept;     // two corners of four words per node
  [[nodiscard]] std::size_t sphere_words() const noexcept;  // spheres in the tree's order
  [[nodiscard]] std::size_t order_words() const noexcept;   // their particles
  [[nodiscard]] std::size_t sorted_words() const noexcept;  // two lists of (place, particle)
  [[nodiscard]] std::size_t scratch_words() const noexcept;  // counts of 256 digits, and their sums

 private:
  HierarchyParameters parameters_;
};

// One sort by eight bits of the place on the curve: its lowest bit, where the list that is read
// begins.
struct SortPass {
  std::uint32_t shift = 0;
  std::uint32_t from = 0;
};
// Four, which end in the first list.
[[nodiscard]] std::array<SortPass, 4> sort_passes(const Hierarchy& hierarchy);

// Beams of the picture, 4×2 pixels each, in blocks of 8×8 of them (bvh.comp.glsl).
struct BeamGrid {
  std::uint32_t columns = 0;  // blocks
  std::uint32_t rows = 0;
  [[nodiscard]] std::uint32_t beams() const noexcept { return 64 * columns * rows; }
};
[[nodiscard]] BeamGrid beam_grid(int width, int height);

// Groups of 64 invocations in the rows of TRI_GROUP_COLUMNS that hierarchy.glsl counts in.
[[nodiscard]] std::array<std::uint32_t, 2> group_rows(std::uint32_t invocations);

}  // namespace triptych::technique
