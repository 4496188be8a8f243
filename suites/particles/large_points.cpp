#include "suites/particles/large_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace triptych::particles_suite {
namespace {

// Returns the length of a sphere's silhouette along one axis of the image plane at distance 1, or 0
// if no part of the sphere is in front of the eye. The sphere has the radius `r`, and its centre
// lies at `a` along this axis and at `z` along the view axis. The silhouette is extended by
// `margin` at both ends, and clipped to [−reach, reach]. Uses the same formulas as
// tri_sphere_interval (technique/portable/sphere_math.h).
double length_on_image(double a, double z, double r, double margin, double reach) {
  const double side = std::abs(a);  // the silhouette is symmetric about the axis
  const double k2 = side * side + z * z - r * r;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  if (k2 > 0) {
    const double k = std::sqrt(k2);
    const double low_z = z * k + side * r;
    const double high_z = z * k - side * r;
    if (low_z <= 0) return 0;
    low = (side * k - z * r) / low_z;
    if (high_z > 0) high = (side * k + z * r) / high_z;
  }
  return std::max(0.0, std::min(high + margin, reach) - std::max(low - margin, -reach));
}

// Calls take(size) for every sphere whose silhouette is in view; `size` is its width and height in
// pixels.
template <class Take>
void for_each_silhouette(const scene::ParticleScene& scene, Take&& take) {
  const scene::Camera& camera = scene.camera;
  const double half_y = scene::tangent_of_half(camera.fov_y_deg);
  const double half_x = half_y * scene.width / scene.height;
  const glm::dvec2 pixel(2 * half_x / scene.width, 2 * half_y / scene.height);
  const glm::dvec3 right = camera.right();
  for (std::size_t i = 0; i < scene.particles->count(); ++i) {
    const std::array<float, 4>& sphere = scene.particles->spheres[i];
    const glm::dvec3 to = glm::dvec3(sphere[0], sphere[1], sphere[2]) - camera.eye;
    const double z = glm::dot(to, camera.forward);
    const double r = scene.radius(i);
    const glm::dvec2 size(
        length_on_image(glm::dot(to, right), z, r, pixel.x / 64, half_x) / pixel.x,
        length_on_image(glm::dot(to, camera.up), z, r, pixel.y / 64, half_y) / pixel.y);
    if (size.x > 0 && size.y > 0) take(size);
  }
}

}  // namespace

std::map<std::string, double> open_counts_of_quads(const scene::ParticleScene& scene,
                                                   double largest, bool occlusion) {
  // A margin for round-off. A device computes a size with about 16 operations, each with a relative
  // error of 2⁻²⁴. In images of less than 16,384 pixels per side, the total error is below 1/64
  // pixel.
  constexpr double rounding = 1.0 / 64;
  const double image_pixels = static_cast<double>(scene.width) * scene.height;
  double quads = 0;
  double corners = 0;
  for_each_silhouette(scene, [&](const glm::dvec2& size) {
    const double side = std::max(size.x, size.y);
    if (side <= largest - rounding) return;
    quads += 1;
    const double square = std::min(std::ceil(side + 1), static_cast<double>(scene.width)) *
                          std::min(std::ceil(side + 1), static_cast<double>(scene.height));
    corners += square - std::floor(size.x) * std::floor(size.y);
  });
  if (quads == 0) return {};
  std::map<std::string, double> open{
      {"vertices", 3 * quads}, {"fragments", corners}, {"fragments_discarded", corners}};
  if (occlusion) {
    const auto all = static_cast<double>(scene.particles->count());
    for (const char* counter :
         {"cells_culled", "particles_culled", "particles_submitted", "sprites"}) {
      open[counter] = all;
    }
    open["vertices"] = 4 * all;
    for (const char* counter : {"fragments", "fragments_discarded", "fragments_kept"}) {
      open[counter] = all * image_pixels;
    }
  }
  return open;
}

}  // namespace triptych::particles_suite
