#include "judge/baselines/reference_hash.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/hash.hpp"

namespace triptych::judge {
namespace {

constexpr double cells_per_unit = 4096;
constexpr double largest_cell = 1e12;  // in cells of 1/4096; larger values and NaN become one value

std::string grid_hash(const core::Image& image, double offset) {
  std::vector<std::int64_t> cells{image.width, image.height};
  cells.reserve(2 + image.rgba.size());
  for (const float value : image.rgba) {
    const double cell = std::floor(cells_per_unit * static_cast<double>(value) + offset);
    cells.push_back(std::abs(cell) <= largest_cell ? static_cast<std::int64_t>(cell) : INT64_MAX);
  }
  return core::content_hash(std::as_bytes(std::span(cells)));
}

}  // namespace

ReferenceHash reference_hash(const core::Image& image) {
  // These offsets are in units of the cell width, 1/4096. With them, 0, 1 and all other multiples
  // of half a cell width lie in the middle between a cell's centre and its edge, so that round-off
  // cannot move them to another cell.
  return {grid_hash(image, 0.25), grid_hash(image, 0.75)};
}

bool is_same_reference(const ReferenceHash& a, const ReferenceHash& b) {
  return a[0] == b[0] || a[1] == b[1];
}

}  // namespace triptych::judge
