#include "backends/gl/large_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <ranges>

#include "scene/camera.hpp"
#include "technique/particles/margins.hpp"

namespace triptych::gl_backend {

double point_margin(const Api& gl) {
  GLfloat granularity = 0;
  gl.GetFloatv(GL_POINT_SIZE_GRANULARITY, &granularity);
  return technique::point_margin(gl.text(GL_RENDERER), static_cast<double>(granularity)) +
         2 * technique::sprite_growth(gl.sub_pixel_bits());
}

double largest_point(const Api& gl) {
  std::array<GLfloat, 2> range{};
  gl.GetFloatv(GL_POINT_SIZE_RANGE, range.data());
  return static_cast<double>(range[1]);
}

std::vector<technique::Cell> cells_with_large_points(const Api& gl,
                                                     const scene::ParticleScene& scene,
                                                     const technique::Arrangement& arrangement) {
  std::vector<technique::Cell> cells = arrangement.cells;
  // Silhouettes are clipped to the image, so a point never has to be larger than the image.
  const double largest = largest_point(gl);
  const bool all_small = std::max(scene.width, scene.height) + 4 <= largest;
  const double pixel = 2 * scene::tangent_of_half(scene.camera.fov_y_deg) / scene.height;
  // Let r be the radius of a sphere, a the coordinate of its centre along one axis of the image,
  // and z its distance along the view axis. The two tangents from the eye to the sphere enclose an
  // interval of length 2r√(a² + z² − r²)/(z² − r²) along this axis of the image plane at distance
  // 1. A small amount is added for the margins of sprites and points, and for round-off.
  const auto may_be_large = [&](const std::array<float, 4>& sphere) {
    const glm::dvec3 to = glm::dvec3(sphere[0], sphere[1], sphere[2]) - scene.camera.eye;
    const double r = static_cast<double>(sphere[3]);
    const double z = glm::dot(to, scene.camera.forward);
    if (z <= r) return z > -r;
    const double a = std::max(std::abs(glm::dot(to, scene.camera.right())),
                              std::abs(glm::dot(to, scene.camera.up)));
    const double width = 2 * r * std::sqrt(a * a + (z - r) * (z + r)) / ((z - r) * (z + r));
    return 1.01 * width / pixel + 4 > largest;
  };
  const auto any_large = [&](const technique::Cell& cell) {
    const auto places = std::views::iota(cell.begin, cell.begin + cell.count);
    return std::ranges::any_of(
        places, [&](std::uint32_t k) { return may_be_large(arrangement.sphere(k)); });
  };
  for (technique::Cell& cell : cells) {
    if (all_small || !any_large(cell)) cell.count = 0;
  }
  return cells;
}

}  // namespace triptych::gl_backend
