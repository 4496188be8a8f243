#pragma once
// What is known of spheres without drawing them; S1 … S6 are the numbers under which the facts are
// known in this project.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

namespace triptych::reference {

// S1: the silhouette of a sphere in a pinhole image, an ellipse whose major axis runs through the
// image's centre: the cone of half angle α (sin α = radius/distance) at an angle θ to the view
// axis, cut by the plane at `focal` from the eye. Lengths are in the unit of `focal`.
struct SilhouetteEllipse {
  double centre = 0;      // distance from the image's centre
  double semi_major = 0;  // towards it
  double semi_minor = 0;
  double area = 0;
};
// Nothing where the cone is not cut all around (θ + α ≥ 90°) or the eye is inside (sin α ≥ 1).
[[nodiscard]] std::optional<SilhouetteEllipse> s1_silhouette(double sin_alpha, double theta,
                                                             double focal);

// S2: where a ray from the origin in the unit `direction` first meets a sphere that it does not
// start in.
struct SphereEntry {
  double t = 0;
  glm::dvec3 normal{};
};
[[nodiscard]] std::optional<SphereEntry> s2_entry(const glm::dvec3& direction,
                                                  const glm::dvec3& centre, double radius);

// S3: mean over the disc of the cosine to the view axis, seen from afar: ∫₀¹ √(1−ρ²)·2ρ dρ.
inline constexpr double s3_mean_cosine = 2.0 / 3.0;

// S4: two equal spheres meet in the plane that bisects their centres; signed distance of a point
// from it, positive on the side of `first`.
[[nodiscard]] double s4_bisector(const glm::dvec3& point, const glm::dvec3& first,
                                 const glm::dvec3& second);

// S5: expected share of an area that N discs, placed at random on it with wrap-around, leave free.
[[nodiscard]] double s5_uncovered(std::uint64_t discs, double radius, double area);

// S6: area of a disc over that of the regular n-gon around it, n ≥ 3.
[[nodiscard]] double s6_tightness(int corners);

}  // namespace triptych::reference
