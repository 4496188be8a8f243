#include "technique/particles/hierarchy.hpp"

#include <algorithm>
#include <limits>

namespace triptych::technique {
namespace {

constexpr std::uint32_t fewest_of_leaf = 4;
constexpr std::uint32_t digits = 256;  // TRI_DIGITS in hierarchy.glsl
constexpr float grid_cells = 1023;
constexpr std::uint32_t group_columns = 65535;  // TRI_GROUP_COLUMNS in hierarchy.glsl

struct Cube {
  std::array<float, 3> low{};
  float edge = 0;
};

// Returns a cube that contains all spheres, computed from the boxes of the cells.
Cube cube_around(const std::vector<Cell>& cells) {
  if (cells.empty()) return {};
  std::array<float, 3> low = cells.front().lo;
  std::array<float, 3> high = cells.front().hi;
  for (const Cell& cell : cells) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low.at(axis) = std::min(low.at(axis), cell.lo.at(axis));
      high.at(axis) = std::max(high.at(axis), cell.hi.at(axis));
    }
  }
  float edge = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    edge = std::max(edge, high.at(axis) - low.at(axis));
  }
  return {low, edge};
}

std::uint32_t levels_of(std::uint32_t particles) {
  std::uint32_t levels = 0;
  while (particles >> (levels + 1) >= fewest_of_leaf) ++levels;
  return levels;
}

std::size_t at_least_4(std::size_t words) {
  return std::max<std::size_t>(words, 4);
}

}  // namespace

Hierarchy::Hierarchy(const Arrangement& arrangement) {
  const Cube cube = cube_around(arrangement.cells);
  *this = Hierarchy(static_cast<std::uint32_t>(arrangement.count()), cube.low, cube.edge);
}

Hierarchy::Hierarchy(std::uint32_t particles, const std::array<float, 3>& low, float edge) {
  const std::uint32_t levels = levels_of(particles);
  // If the set has no extent, or if the grid's scale would exceed the largest float, all particles
  // get the same position on the Hilbert curve.
  const bool extended = edge > 0 && grid_cells / edge <= std::numeric_limits<float>::max();
  parameters_.origin = {low[0], low[1], low[2], extended ? grid_cells / edge : 0.0F};
  parameters_.shape = {particles, levels, particles >> levels,
                       particles & ((std::uint32_t{1} << levels) - 1)};
}

std::uint32_t Hierarchy::leaf_begin(std::uint32_t leaf) const noexcept {
  return parameters_.shape[2] * leaf + std::min(leaf, parameters_.shape[3]);
}

std::uint32_t Hierarchy::runs() const noexcept {
  constexpr std::uint32_t per_run = 256;
  constexpr std::uint32_t most = 1024;
  return std::clamp(particles() / per_run, std::uint32_t{1}, most);
}

std::size_t Hierarchy::box_words() const noexcept {
  return 8 * 2 * std::size_t{leaves()};
}

std::size_t Hierarchy::sphere_words() const noexcept {
  return at_least_4(4 * std::size_t{particles()});
}

std::size_t Hierarchy::order_words() const noexcept {
  return at_least_4(particles());
}

std::size_t Hierarchy::sorted_words() const noexcept {
  return at_least_4(4 * std::size_t{particles()});
}

std::size_t Hierarchy::scratch_words() const noexcept {
  return digits * (std::size_t{runs()} + 1);
}

std::array<SortPass, 4> sort_passes(const Hierarchy& hierarchy) {
  const std::uint32_t second = hierarchy.particles();
  return {{{0, 0}, {8, second}, {16, 0}, {24, second}}};
}

BeamGrid beam_grid(int width, int height) {
  const auto parts = [](int size, int part) {
    return static_cast<std::uint32_t>((size + part - 1) / part);
  };
  return {parts(width, 32), parts(height, 16)};
}

std::array<std::uint32_t, 2> group_rows(std::uint32_t invocations) {
  const std::uint32_t groups = std::max((invocations + 63) / 64, std::uint32_t{1});
  return {std::min(groups, group_columns), (groups + group_columns - 1) / group_columns};
}

}  // namespace triptych::technique
