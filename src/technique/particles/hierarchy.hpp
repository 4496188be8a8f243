#pragma once
// The shape of the bounding-volume hierarchy that the technique `bvh` builds on the device
// (hierarchy.glsl explains it).

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "technique/particles/arrangement.hpp"

namespace triptych::technique {

// The parameters of all kernels that build or traverse the hierarchy. `step` is TRI_STEP in
// hierarchy.glsl: four numbers whose meaning depends on the kernel.
struct HierarchyParameters {
  // The lower corner of the Hilbert curve's grid; w: grid cells per unit length.
  std::array<float, 4> origin{};
  // The number of particles, the number of levels, the number of particles in the smallest leaves,
  // and the number of leaves that have one more particle than those.
  std::array<std::uint32_t, 4> shape{};
  std::array<std::uint32_t, 4> step{};
};
static_assert(sizeof(HierarchyParameters) == std::size_t{3} * 16);

class Hierarchy {
 public:
  explicit Hierarchy(const Arrangement& arrangement);
  // Describes the hierarchy for this many particles whose centres are in the cube with lower corner
  // `low` and edge length `edge`.
  Hierarchy(std::uint32_t particles, const std::array<float, 3>& low, float edge);

  [[nodiscard]] const HierarchyParameters& parameters() const noexcept { return parameters_; }
  [[nodiscard]] HierarchyParameters with_step(const std::array<std::uint32_t, 4>& step) const {
    HierarchyParameters changed = parameters_;
    changed.step = step;
    return changed;
  }

  [[nodiscard]] std::uint32_t particles() const noexcept { return parameters_.shape[0]; }
  // The number of levels below the root; 0 if the root is the only leaf.
  [[nodiscard]] std::uint32_t levels() const noexcept { return parameters_.shape[1]; }
  [[nodiscard]] std::uint32_t leaves() const noexcept { return std::uint32_t{1} << levels(); }
  // Returns the index of the leaf's first particle in the order of the tree.
  [[nodiscard]] std::uint32_t leaf_begin(std::uint32_t leaf) const noexcept;
  // Returns the number of runs into which the radix sort divides the particles, with one invocation
  // for each run. There are at most 1,024 runs, so that the loop over their counts stays below
  // the limit of llvmpipe and lavapipe on loop iterations (technique/volume/long_rays.hpp).
  [[nodiscard]] std::uint32_t runs() const noexcept;

  // The sizes of the buffers in words of four bytes. Each is at least 4, because no API allows an
  // empty buffer.
  [[nodiscard]] std::size_t box_words() const noexcept;     // two corners of four words per node
  [[nodiscard]] std::size_t sphere_words() const noexcept;  // spheres in tree order
  [[nodiscard]] std::size_t order_words() const noexcept;   // particle indices in tree order
  // Two lists of pairs (position on the Hilbert curve, particle index). Each pass of the radix sort
  // reads one of the lists and writes the other.
  [[nodiscard]] std::size_t sorted_words() const noexcept;
  // The counts of the radix sort. For each of its runs (see runs()), they contain the number of
  // particles with each of the 256 values of the current digit, followed by one total for each
  // value.
  [[nodiscard]] std::size_t scratch_words() const noexcept;

 private:
  HierarchyParameters parameters_;
};

// One pass of the radix sort, which sorts by eight bits of the position on the Hilbert curve.
// `shift` is the index of the lowest of these bits, and `from` is the index at which the input list
// begins.
struct SortPass {
  std::uint32_t shift = 0;
  std::uint32_t from = 0;
};
// Returns the four passes of the sort. The last pass writes its result to the first list.
[[nodiscard]] std::array<SortPass, 4> sort_passes(const Hierarchy& hierarchy);

// The beams of the image, in blocks of 8×8 beams (bvh.comp.glsl). A beam is the bundle of the rays
// of 4×2 pixels.
struct BeamGrid {
  std::uint32_t columns = 0;  // number of blocks
  std::uint32_t rows = 0;
  [[nodiscard]] std::uint32_t beams() const noexcept { return 64 * columns * rows; }
};
[[nodiscard]] BeamGrid beam_grid(int width, int height);

// Returns the number of columns and rows of work groups that are dispatched for this many
// invocations. A group has 64 invocations, and a row has at most TRI_GROUP_COLUMNS groups
// (hierarchy.glsl).
[[nodiscard]] std::array<std::uint32_t, 2> group_rows(std::uint32_t invocations);

}  // namespace triptych::technique
