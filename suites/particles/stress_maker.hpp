#pragma once
// Building blocks for stress scenes.

#include <charconv>
#include <glm/vec3.hpp>
#include <string_view>

#include "suites/particles/stress_cases.hpp"

namespace triptych::particles_suite {

using scene::camera_looking_at;

// Width and height of most stress images, in pixels.
inline constexpr int stress_side = 96;

// Returns the number at the beginning of a variant, such as 64 for "64x48", or 0 if the variant
// does not begin with a number.
template <typename Number>
[[nodiscard]] Number number_in(std::string_view variant) {
  Number number = 0;
  std::from_chars(variant.data(), variant.data() + variant.size(), number);
  return number;
}

// Returns a unit vector that is oblique to all axes.
[[nodiscard]] glm::dvec3 oblique();

class StressMaker {
 public:
  StressMaker(scene::ColourKind colour, const scene::Camera& camera, int width, int height);

  // Adds the next particle. An invalid sphere is dropped, but still uses up its particle number.
  void add(const glm::dvec3& centre, double radius);
  // Adds a particle at a place in the image, given in pixels from the upper left corner, at the
  // distance `depth` along the view axis, with a radius in pixels at that depth.
  void add_at(double x, double y, double depth, double radius_px);
  // Skips one particle number.
  void skip() { ++next_; }

  // Returns the world-space point at a position in the image (in pixels) and a depth.
  [[nodiscard]] glm::dvec3 place(double x, double y, double depth) const;
  // Returns the edge length of a pixel at distance 1 along the view axis.
  [[nodiscard]] double pixel() const;

  [[nodiscard]] StressScene take();

 private:
  StressScene scene_;
  std::uint32_t next_ = 0;
};

// Creates a scene from existing particles.
[[nodiscard]] StressScene stress_of(scene::ParticleSet set, const scene::Camera& camera, int width,
                                    int height);

}  // namespace triptych::particles_suite
