#include "scene/particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/error.hpp"
#include "core/hash.hpp"

namespace triptych::scene {

std::string_view name_of(ColourKind kind) {
  switch (kind) {
    case ColourKind::rgba8:
      return "rgba8";
    case ColourKind::rgba32:
      return "rgba32";
    case ColourKind::intensity:
      return "intensity";
  }
  return {};
}

ColourKind colour_kind(std::string_view name) {
  for (const ColourKind kind : {ColourKind::rgba8, ColourKind::rgba32, ColourKind::intensity}) {
    if (name == name_of(kind)) return kind;
  }
  throw core::InputError(
      fmt::format("unknown colour '{}'; expected rgba8, rgba32 or intensity", name));
}

std::string particle_hash(const ParticleSet& set) {
  return core::HashBuilder("particles")
      .add_array(std::span(set.spheres))
      .add_array(std::span(set.ids))
      .add(name_of(set.colour))
      .add_array(std::span(set.rgba8))
      .add_array(std::span(set.rgba32))
      .add_array(std::span(set.intensity))
      .add(set.dropped)
      .hash();
}

Box bounding_box(const ParticleSet& set) {
  if (set.spheres.empty()) return {};
  Box box{glm::dvec3(std::numeric_limits<double>::infinity()),
          glm::dvec3(-std::numeric_limits<double>::infinity())};
  for (const auto& [x, y, z, r] : set.spheres) {
    const glm::dvec3 centre{x, y, z};
    const double radius = r;
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = std::min(box.lo[axis], centre[axis] - radius);
      box.hi[axis] = std::max(box.hi[axis], centre[axis] + radius);
    }
  }
  return box;
}

bool append(ParticleSet& set, const std::array<double, 4>& sphere, std::uint32_t index) {
  std::array<float, 4> rounded{};
  for (std::size_t i = 0; i < 4; ++i) rounded[i] = static_cast<float>(sphere[i]);
  const bool finite =
      std::ranges::all_of(rounded, [](float value) { return std::isfinite(value); });
  if (!finite || !(rounded[3] > 0)) {
    ++set.dropped;
    return false;
  }
  set.spheres.push_back(rounded);
  set.ids.push_back(index);
  return true;
}

}  // namespace triptych::scene
