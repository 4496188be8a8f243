#pragma once
// Building blocks of the stress scenes.

#include <glm/vec3.hpp>

#include "suites/particles/stress_cases.hpp"

namespace triptych::particles_suite {

using scene::looking;

// A direction that is oblique to all axes, of unit length.
[[nodiscard]] glm::dvec3 oblique();

class StressMaker {
 public:
  StressMaker(scene::ColourKind colour, const scene::Camera& camera, int width, int height);

  // The next particle; one that is no sphere is dropped and keeps its number.
  void add(const glm::dvec3& centre, double radius);
  // At a place in the picture, in pixels from its upper left corner, at the distance `depth` along
  // the view axis, with a radius in pixels of that depth.
  void add_at(double x, double y, double depth, double radius_px);
  // Leaves a number out.
  void skip() { ++next_; }

  [[nodiscard]] glm::dvec3 place(double x, double y, double depth) const;
  // Edge of a pixel at distance 1 along the view axis.
  [[nodiscard]] double pixel() const;

  [[nodiscard]] StressScene take();

 private:
  StressScene scene_;
  std::uint32_t next_ = 0;
};

// A scene of particles that exist already.
[[nodiscard]] StressScene stress_of(scene::ParticleSet set, const scene::Camera& camera, int width,
                                    int height);

}  // namespace triptych::particles_suite
