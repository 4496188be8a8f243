#pragma once
// Properties of spheres that can be computed without drawing them. In this project, they are
// numbered S1 … S6. Tests compare them with drawn images.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

namespace triptych::reference {

// Property S1: the silhouette of a sphere in a pinhole image is an ellipse whose major axis passes
// through the image's centre: the intersection of the image plane, at distance `focal` from the
// eye, with a cone. The cone has the half angle α (sin α = radius/distance), and its axis is at an
// angle θ to the view axis. Lengths are in the unit of `focal`.
struct SilhouetteEllipse {
  double centre = 0;      // distance from the image's centre
  double semi_major = 0;  // along the direction towards the image's centre
  double semi_minor = 0;
  double area = 0;
};
// Returns nullopt if the plane does not cut the cone completely (θ + α ≥ 90°) or if the eye is
// inside the sphere (sin α ≥ 1).
[[nodiscard]] std::optional<SilhouetteEllipse> s1_silhouette(double sin_alpha, double theta,
                                                             double focal);

// Property S2: the first intersection of a sphere and a ray from the origin along the unit vector
// `direction`. The sphere must not contain the origin.
struct SphereEntry {
  double t = 0;
  glm::dvec3 normal{};
};
[[nodiscard]] std::optional<SphereEntry> s2_entry(const glm::dvec3& direction,
                                                  const glm::dvec3& centre, double radius);

// Property S3: the mean cosine between the surface normal and the view axis, over the disc of a
// sphere that is far away: ∫₀¹ √(1−ρ²)·2ρ dρ, where ρ is the distance from the middle of the disc
// in radii.
inline constexpr double s3_mean_cosine = 2.0 / 3.0;

// Property S4: two equal spheres intersect in the plane that bisects the line between their
// centres. Returns the signed distance of a point from this plane, which is positive on the side of
// `first`.
[[nodiscard]] double s4_bisector(const glm::dvec3& point, const glm::dvec3& first,
                                 const glm::dvec3& second);

// Property S5: the expected share of an area that remains uncovered if N discs are placed on it at
// random, where discs wrap around at the edges.
[[nodiscard]] double s5_uncovered(std::uint64_t discs, double radius, double area);

// Property S6: the area of a disc divided by the area of the regular n-gon that is circumscribed
// around it, for n ≥ 3.
[[nodiscard]] double s6_tightness(int corners);

}  // namespace triptych::reference
