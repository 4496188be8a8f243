#pragma once
// One ray and one sphere: where the ray meets it, and where rays beside it may.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace triptych::reference {

// How a ray from the origin passes a sphere. Foot of the perpendicular first, then r² − p²: the
// form that does not cancel, however far away the sphere is.
struct Passage {
  double distance = 0;      // of the centre from the eye
  double along = 0;         // b: of the centre, along the ray
  double across = 0;        // p: of the centre, from the ray
  double half_squared = 0;  // h² = r² − p²: the half chord, negative where the ray misses
  double radius = 0;
};

// `direction` is unit, `centre` is relative to the eye.
inline Passage passage(const glm::dvec3& direction, const glm::dvec3& centre, double radius) {
  const double along = glm::dot(centre, direction);
  const glm::dvec3 foot = centre - along * direction;
  const double squared = glm::dot(foot, foot);
  return {std::sqrt(glm::dot(centre, centre)), along, std::sqrt(squared), radius * radius - squared,
          radius};
}

// Distance along the ray to the first surface point in front of the eye: where the sphere is
// entered or, from inside, left; +inf for none.
inline double first_surface(const Passage& ray) {
  if (!(ray.half_squared >= 0)) return std::numeric_limits<double>::infinity();
  const double half = std::sqrt(ray.half_squared);
  if (ray.along - half > 0) return ray.along - half;
  if (ray.along + half > 0) return ray.along + half;
  return std::numeric_limits<double>::infinity();
}

// What may be off. `chord` is the largest |d' − d| of two unit directions, the shift is that of
// the sphere's centre across the ray relative to its radius, the skin how near to its surface
// the eye may be taken for being on the other side, relative to distance + radius.
struct Wobble {
  double chord = 0;
  double shift = 0;
  double skin = 0;
};

// What all rays that a wobble allows find of one sphere.
struct Reach {
  bool possible = false;  // some ray may meet it; otherwise nothing below is meant
  bool covers = false;    // every ray meets it
  double nearest = 0;     // least and largest distance along a ray …
  double farthest = 0;
  double half_lo = 0;  // … and half chord where it is met
  double half_hi = 0;
};

// Seen from the ray, the centre C (at b along it, p across) turns about the eye by an angle φ,
// 2·sin(φ/2) ≤ chord, and shifts across by up to shift·r:
//   |p' − p| ≤ δ = chord·|C| + shift·r,
//   |b' − b| = |b·(cos φ − 1) ± p·sin φ| ≤ Δb = p·chord + |b|·chord²/2,
//   h'² = r² − p'² between h² − ((p + δ)² − p²) and h² + (p² − (p − δ)²),
// with p' never above |C| + shift·r nor below 0. The interval of t = b' ∓ h' follows term by
// term. h² is changed rather than computed afresh, so that no wobble is no change to the bit.
inline Reach reach(const Passage& ray, const Wobble& wobble) {
  Reach result;
  const double shift = wobble.shift * ray.radius;
  const double delta = wobble.chord * ray.distance + shift;
  const double down = std::min(delta, ray.across);
  const double highest = ray.half_squared + down * (2 * ray.across - down);
  if (!(highest >= 0)) return result;
  const double room = std::max(ray.distance + shift - ray.across, 0.0);
  const double up = std::min(delta, room);
  const double lowest = ray.half_squared - up * (2 * ray.across + up);
  const double slide =
      wobble.chord * (ray.across + 0.5 * wobble.chord * std::abs(ray.along));  // Δb
  result.half_hi = std::sqrt(highest);
  result.half_lo = std::sqrt(std::max(lowest, 0.0));

  const double rounding = 1e-14;
  const double skin = shift + (wobble.skin + rounding) * (ray.distance + ray.radius);
  const double outside = ray.distance - ray.radius;
  if (std::abs(outside) <= skin) {  // the first surface may be either of the two
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
