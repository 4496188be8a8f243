#pragma once
// The intersection of a ray with a sphere, and the possible intersections of nearby rays.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace triptych::reference {

// How a ray from the eye passes a sphere. p² is computed from the foot of the perpendicular, so
// that r² − p² is accurate however far away the sphere is.
struct Passage {
  double distance = 0;      // distance of the centre from the eye
  double along = 0;         // b: position of the centre along the ray
  double across = 0;        // p: distance of the centre from the ray
  double half_squared = 0;  // h² = r² − p², with h half the chord; negative if the ray misses
  double radius = 0;        // r
};

// Returns how a ray passes a sphere. `direction` is a unit vector, and `centre` is relative to the
// eye.
inline Passage passage(const glm::dvec3& direction, const glm::dvec3& centre, double radius) {
  const double along = glm::dot(centre, direction);
  const glm::dvec3 foot = centre - along * direction;
  const double squared = glm::dot(foot, foot);
  return {std::sqrt(glm::dot(centre, centre)), along, std::sqrt(squared), radius * radius - squared,
          radius};
}

// Returns the distance along the ray to the first surface point in front of the eye: where the ray
// enters the sphere, or where it leaves the sphere if the eye is inside. Returns +inf if there is
// no such point.
inline double first_surface(const Passage& ray) {
  if (!(ray.half_squared >= 0)) return std::numeric_limits<double>::infinity();
  const double half = std::sqrt(ray.half_squared);
  if (ray.along - half > 0) return ray.along - half;
  if (ray.along + half > 0) return ray.along + half;
  return std::numeric_limits<double>::infinity();
}

// The errors that a device may have. `chord` is the largest |d' − d|, where d' is the unit
// direction of the device's ray and d that of the exact ray. `shift` is the displacement of the
// sphere's centre across the ray, relative to the radius. If the eye is closer to the surface than
// `skin` (relative to distance + radius), it may be on the other side of the surface on a device.
struct GeometryError {
  double chord = 0;
  double shift = 0;
  double skin = 0;
};

// The possible results for one sphere, over all rays that the errors of a device (GeometryError)
// allow.
struct HitRange {
  // Whether some ray may hit the sphere. If not, the members below are meaningless.
  bool possible = false;
  bool covers = false;  // whether every ray hits the sphere
  double nearest = 0;   // smallest distance along a ray that hits the sphere
  double farthest = 0;
  double half_lo = 0;  // smallest half chord of a ray that hits the sphere
  double half_hi = 0;
};

// A prime marks a quantity of a device, φ is the angle between the device's ray and the exact ray,
// and the other symbols are those of Passage. Seen from the ray, the centre C (at b along the ray
// and p across it) rotates about the eye by φ, with 2·sin(φ/2) ≤ chord, and shifts across the ray
// by up to shift·r:
//   |p' − p| ≤ δ = chord·|C| + shift·r,
//   |b' − b| = |b·(cos φ − 1) ± p·sin φ| ≤ Δb = p·chord + |b|·chord²/2,
//   h'² = r² − p'² between h² − ((p + δ)² − p²) and h² + (p² − (p − δ)²),
// with p' between 0 and |C| + shift·r. The bounds on t = b' ∓ h' are the sums of the bounds on its
// two terms. The bounds on h'² are computed from h² instead of from p', so that without errors,
// the result is bit-identical to that for the exact ray.
inline HitRange hit_range(const Passage& ray, const GeometryError& error) {
  HitRange result;
  const double shift = error.shift * ray.radius;
  const double delta = error.chord * ray.distance + shift;
  const double down = std::min(delta, ray.across);
  const double highest = ray.half_squared + down * (2 * ray.across - down);
  if (!(highest >= 0)) return result;
  const double largest_shift = std::max(ray.distance + shift - ray.across, 0.0);
  const double up = std::min(delta, largest_shift);
  const double lowest = ray.half_squared - up * (2 * ray.across + up);
  // Δb, the bound on |b' − b| that is derived above.
  const double slide = error.chord * (ray.across + 0.5 * error.chord * std::abs(ray.along));
  result.half_hi = std::sqrt(highest);
  result.half_lo = std::sqrt(std::max(lowest, 0.0));

  const double rounding = 1e-14;
  const double skin = shift + (error.skin + rounding) * (ray.distance + ray.radius);
  const double outside = ray.distance - ray.radius;
  if (std::abs(outside) <= skin) {
    // The eye may be inside or outside the sphere, so both surface points are possible.
    result.farthest = ray.along + slide + result.half_hi;
    result.possible = result.farthest > 0;
  } else if (outside < 0) {
    result.possible = result.covers = true;
    result.nearest = std::max(ray.along - slide + result.half_lo, 0.0);
    result.farthest = ray.along + slide + result.half_hi;
  } else {
    result.possible = ray.along + slide > 0;
    result.covers = lowest > 0 && ray.along - slide > 0;
    result.nearest = std::max(ray.along - slide - result.half_hi, 0.0);
    result.farthest = ray.along + slide - result.half_lo;
  }
  return result;
}

}  // namespace triptych::reference
