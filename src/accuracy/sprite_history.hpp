#pragma once
// Compares one pixel of a device's particle image with the expectation of the reference: for each
// sphere alone, and for the smallest set of spheres with which the pixel is wrong.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace triptych::accuracy {

// The result of a device in a pixel. The id is core::Image::no_particle if no particle is visible.
struct ShownSurface {
  std::uint32_t id = 0;
  double depth = 0;  // along the view axis
  std::array<double, 4> colour{};
};

// The result of the reference, and the allowed difference of a device. If the pixel is not certain,
// another id and depth are allowed, and the bound of the colour covers them.
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
  particle,    // another one
  depth,       // the right particle at another depth
  colour       // the right one at the right depth in another colour
};
[[nodiscard]] std::string_view name_of(SurfaceDifference difference);
[[nodiscard]] SurfaceDifference compare(const ExpectedSurface& expected, const ShownSurface& shown);

// One sphere that the pixel's ray may meet, drawn alone.
struct SpriteRow {
  std::uint32_t id = 0;
  ExpectedSurface expected;
  ShownSurface shown;
  SurfaceDifference differs = SurfaceDifference::none;
};

struct SpriteHistory {
  std::vector<SpriteRow> rows;       // from front to back
  std::size_t left_out = 0;          // spheres behind them, which were not drawn
  std::optional<std::size_t> first;  // the first row that differs
  // If the pixel is wrong and no row is: the ids of the smallest set found with which it is wrong.
  // No part of it can be left out, unless `stopped_early`.
  std::vector<std::uint32_t> fewest;
  SurfaceDifference fewest_differs = SurfaceDifference::none;
  bool stopped_early = false;
};

// A set of particles, by their indices.
using Particles = std::vector<std::uint32_t>;
struct Fewest {
  Particles particles;
  bool stopped_early = false;
};
// Leaves out parts of `particles`, for which `wrong` holds, as long as it still holds; calls it at
// most `most_calls` times. The algorithm is ddmin (Zeller and Hildebrandt 2002).
[[nodiscard]] Fewest fewest_of(Particles particles,
                               const std::function<bool(const Particles&)>& wrong, int most_calls);

}  // namespace triptych::accuracy
