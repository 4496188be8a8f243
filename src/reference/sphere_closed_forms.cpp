#include "reference/sphere_closed_forms.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace triptych::reference {

using std::numbers::pi;

// A direction (x, y, f), where f is the focal length, is on the cone with half angle α around
// (sin θ, 0, cos θ) if
//   (x·sin θ + f·cos θ)² = cos²α·(x² + y² + f²).
// Completing the square in x with q = cos²θ − sin²α gives the centre and the axes.
std::optional<SilhouetteEllipse> s1_silhouette(double sin_alpha, double theta, double focal) {
  const double sine = std::sin(theta);
  const double cosine = std::cos(theta);
  const double q = (cosine - sin_alpha) * (cosine + sin_alpha);
  if (!(sin_alpha < 1) || !(cosine > sin_alpha)) return std::nullopt;
  const double cos_alpha = std::sqrt((1 - sin_alpha) * (1 + sin_alpha));
  SilhouetteEllipse ellipse;
  ellipse.centre = focal * sine * cosine / q;
  ellipse.semi_major = focal * sin_alpha * cos_alpha / q;
  ellipse.semi_minor = focal * sin_alpha / std::sqrt(q);
  ellipse.area = pi * ellipse.semi_major * ellipse.semi_minor;
  return ellipse;
}

std::optional<SphereEntry> s2_entry(const glm::dvec3& direction, const glm::dvec3& centre,
                                    double radius) {
  const double along = glm::dot(centre, direction);
  const glm::dvec3 foot = centre - along * direction;
  const double half_squared = radius * radius - glm::dot(foot, foot);
  if (!(half_squared >= 0) || !(along > 0)) return std::nullopt;
  const double t = along - std::sqrt(half_squared);
  return SphereEntry{t, (t * direction - centre) / radius};
}

double s4_bisector(const glm::dvec3& point, const glm::dvec3& first, const glm::dvec3& second) {
  const glm::dvec3 apart = first - second;
  return glm::dot(point - 0.5 * (first + second), apart) / glm::length(apart);
}

double s5_uncovered(std::uint64_t discs, double radius, double area) {
  return std::exp(static_cast<double>(discs) * std::log1p(-pi * radius * radius / area));
}

double s6_tightness(int corners) {
  return pi / (corners * std::tan(pi / corners));
}

}  // namespace triptych::reference
