#pragma once
#include <cstdint>
#include <span>

#include "scene/particles.hpp"

namespace triptych::scene {

// Returns the particles with these indices, in the order of the indices. The particles keep their
// ids.
[[nodiscard]] inline ParticleSet particle_subset(const ParticleSet& set,
                                                 std::span<const std::uint32_t> indices) {
  ParticleSet subset;
  subset.name = set.name;
  subset.colour = set.colour;
  for (const std::uint32_t index : indices) {
    subset.spheres.push_back(set.spheres[index]);
    subset.ids.push_back(set.ids[index]);
    if (set.colour == ColourKind::rgba8) subset.rgba8.push_back(set.rgba8[index]);
    if (set.colour == ColourKind::rgba32) subset.rgba32.push_back(set.rgba32[index]);
    if (set.colour == ColourKind::intensity) subset.intensity.push_back(set.intensity[index]);
  }
  subset.hash = particle_hash(subset);
  return subset;
}

}  // namespace triptych::scene
