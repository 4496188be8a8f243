#include "accuracy/sprite_history.hpp"

#include <algorithm>
#include <cmath>

#include "core/image.hpp"

namespace triptych::accuracy {
namespace {

bool matches_colour(const ExpectedSurface& expected, const DrawnSurface& drawn) {
  for (std::size_t channel = 0; channel < 4; ++channel) {
    const double error = std::abs(drawn.colour[channel] - expected.colour[channel]);
    if (!(error <= expected.colour_bound)) return false;
  }
  return true;
}

}  // namespace

std::string_view name_of(SurfaceDifference difference) {
  switch (difference) {
    case SurfaceDifference::none:
      return "no difference";
    case SurfaceDifference::missing:
      return "missing particle";
    case SurfaceDifference::unexpected:
      return "unexpected particle";
    case SurfaceDifference::particle:
      return "different particle";
    case SurfaceDifference::depth:
      return "depth";
    case SurfaceDifference::colour:
      return "colour";
  }
  return "";
}

SurfaceDifference compare(const ExpectedSurface& expected, const DrawnSurface& drawn) {
  if (expected.certain && expected.id != drawn.id) {
    if (drawn.id == core::Image::no_particle) return SurfaceDifference::missing;
    return expected.id == core::Image::no_particle ? SurfaceDifference::unexpected
                                                   : SurfaceDifference::particle;
  }
  const bool has_depth = expected.certain && expected.id != core::Image::no_particle;
  if (has_depth && !(std::abs(drawn.depth - expected.depth) <= expected.depth_bound)) {
    return SurfaceDifference::depth;
  }
  return matches_colour(expected, drawn) ? SurfaceDifference::none : SurfaceDifference::colour;
}

SmallestSet smallest_set_of(Particles particles, const std::function<bool(const Particles&)>& wrong,
                            int most_calls) {
  std::size_t parts = 2;
  while (particles.size() > 1) {
    bool smaller = false;
    for (std::size_t part = 0; part < parts && !smaller; ++part) {
      if (most_calls-- <= 0) return {.particles = std::move(particles), .stopped_early = true};
      const auto begin = static_cast<std::ptrdiff_t>(particles.size() * part / parts);
      const auto end = static_cast<std::ptrdiff_t>(particles.size() * (part + 1) / parts);
      Particles remaining(particles.begin(), particles.begin() + begin);
      remaining.insert(remaining.end(), particles.begin() + end, particles.end());
      if (!wrong(remaining)) continue;
      particles = std::move(remaining);
      parts = std::max<std::size_t>(parts - 1, 2);
      smaller = true;
    }
    if (smaller) {
      parts = std::min(parts, particles.size());
    } else if (parts >= particles.size()) {
      break;
    } else {
      parts = std::min(2 * parts, particles.size());
    }
  }
  return {.particles = std::move(particles), .stopped_early = false};
}

}  // namespace triptych::accuracy
