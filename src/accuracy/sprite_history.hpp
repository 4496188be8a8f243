#pragma once
// Compares one pixel of a device's particle image with the result of the reference renderer: for
// each sphere alone, and for the smallest set of spheres for which the pixel is wrong.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace triptych::accuracy {

// The surface that a device shows in a pixel. The id is core::Image::no_particle if no particle is
// visible.
struct DrawnSurface {
  std::uint32_t id = 0;
  double depth = 0;  // distance along the view axis
  std::array<double, 4> colour{};
};

// The surface that the reference renderer shows in a pixel, and the differences that are allowed on
// a device. A pixel is certain if rounding cannot change which particle is visible. If the pixel is
// not certain, a device may show a different id and depth, and the colour bound covers these cases.
struct ExpectedSurface {
  std::uint32_t id = 0;
  double depth = 0;
  double depth_bound = 0;
  std::array<double, 4> colour{};
  double colour_bound = 0;
  bool certain = true;
};

enum class SurfaceDifference : std::uint8_t {
  none,
  missing,     // the device shows no particle
  unexpected,  // the device shows a particle where there is none
  particle,    // the device shows a different particle
  depth,       // the device shows the correct particle at a wrong depth
  colour       // the device shows the correct particle and depth in a wrong colour
};
[[nodiscard]] std::string_view name_of(SurfaceDifference difference);
[[nodiscard]] SurfaceDifference compare(const ExpectedSurface& expected, const DrawnSurface& drawn);

// The result of drawing only one sphere, which the pixel's ray may hit.
struct SpriteRow {
  std::uint32_t id = 0;
  ExpectedSurface expected;
  DrawnSurface shown;
  SurfaceDifference differs = SurfaceDifference::none;
};

struct SpriteHistory {
  std::vector<SpriteRow> rows;       // sorted from front to back
  std::size_t untested = 0;          // number of spheres behind `rows`, which were not drawn alone
  std::optional<std::size_t> first;  // the first row that differs
  // If the pixel is wrong but no row is wrong, these are the ids of the smallest set of spheres
  // that was found for which the pixel is wrong. Unless `stopped_early`, the pixel is correct if
  // any one sphere of the set is left out.
  std::vector<std::uint32_t> smallest_set;
  SurfaceDifference smallest_set_differs = SurfaceDifference::none;
  bool stopped_early = false;
};

// A set of particles, given by their indices.
using Particles = std::vector<std::uint32_t>;
struct SmallestSet {
  Particles particles;
  bool stopped_early = false;  // whether the limit on calls ended the search
};
// Reduces `particles`, for which `wrong` returns true, by leaving out parts as long as `wrong`
// still returns true. Calls `wrong` at most `most_calls` times. The algorithm is ddmin (Zeller and
// Hildebrandt 2002).
[[nodiscard]] SmallestSet smallest_set_of(Particles particles,
                                          const std::function<bool(const Particles&)>& wrong,
                                          int most_calls);

}  // namespace triptych::accuracy
