#include "suites/particles/grown_sprites.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace triptych::particles_suite {
namespace {

// A square in camera space: x to the right, y up, z along the view axis.
struct Square {
  glm::dvec3 centre;
  glm::dvec3 right;  // unit vector
  glm::dvec3 up;
  double half = 0;
  double grown = 0;
};

class Image {
 public:
  explicit Image(const scene::ParticleScene& scene)
      : scene_(scene),
        half_y_(scene::tangent_of_half(scene.camera.fov_y_deg)),
        half_x_(half_y_ * scene.width / scene.height) {}

  // Returns the larger of a pixel's width and height on the image plane at distance 1.
  [[nodiscard]] double pixel() const {
    return std::max(2 * half_x_ / scene_.width, 2 * half_y_ / scene_.height);
  }
  [[nodiscard]] glm::dvec3 in_camera(const std::array<float, 4>& sphere) const {
    const glm::dvec3 to = glm::dvec3(sphere[0], sphere[1], sphere[2]) - scene_.camera.eye;
    return {glm::dot(to, scene_.camera.right()), glm::dot(to, scene_.camera.up),
            glm::dot(to, scene_.camera.forward)};
  }
  // Returns the number of pixels whose rays hit the grown square but not the original square.
  [[nodiscard]] std::uint64_t ring(const Square& square) const;

 private:
  struct Bounds {
    int x_begin, x_end, y_begin, y_end;
  };
  // Returns the range of pixels that the grown square can cover: all pixels if a corner is not in
  // front of the eye.
  [[nodiscard]] Bounds bounds(const Square& square) const;
  [[nodiscard]] double column(double x) const { return (x / half_x_ + 1) * scene_.width / 2; }
  [[nodiscard]] double row(double y) const { return (1 - y / half_y_) * scene_.height / 2; }

  const scene::ParticleScene& scene_;
  double half_y_;
  double half_x_;
};

Image::Bounds Image::bounds(const Square& square) const {
  glm::dvec2 low(INFINITY);
  glm::dvec2 high(-INFINITY);
  for (const glm::dvec2 side : {glm::dvec2(-1, -1), {-1, 1}, {1, -1}, {1, 1}}) {
    const glm::dvec3 corner =
        square.centre + square.grown * (side.x * square.right + side.y * square.up);
    if (!(corner.z > 0)) return {0, scene_.width, 0, scene_.height};
    const glm::dvec2 at(column(corner.x / corner.z), row(corner.y / corner.z));
    low = {std::min(low.x, at.x), std::min(low.y, at.y)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y)};
  }
  const auto within = [](double value, int size) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(size)));
  };
  return {within(std::floor(low.x), scene_.width), within(std::ceil(high.x), scene_.width),
          within(std::floor(low.y), scene_.height), within(std::ceil(high.y), scene_.height)};
}

std::uint64_t Image::ring(const Square& square) const {
  const Bounds area = bounds(square);
  const double plane2 = glm::dot(square.centre, square.centre);
  std::uint64_t count = 0;
  for (int y = area.y_begin; y < area.y_end; ++y) {
    for (int x = area.x_begin; x < area.x_end; ++x) {
      const glm::dvec3 ray((2 * (x + 0.5) / scene_.width - 1) * half_x_,
                           (1 - 2 * (y + 0.5) / scene_.height) * half_y_, 1);
      const double along = glm::dot(ray, square.centre);
      if (!(along > 0)) continue;
      const glm::dvec3 from = ray * (plane2 / along) - square.centre;
      const double off =
          std::max(std::abs(glm::dot(from, square.right)), std::abs(glm::dot(from, square.up)));
      if (off > square.half && off <= square.grown) ++count;
    }
  }
  return count;
}

// Returns the square on which technique/portable/sphere_math.h places a sprite: just in front of
// the sphere, and 1/64 pixel larger than the sphere on each side. Returns nullopt if the sprite
// covers the whole viewport or the sphere is behind the eye.
std::optional<Square> square_of(const glm::dvec3& centre, double radius, double pixel,
                                double growth) {
  const double d = glm::length(centre);
  const bool surrounds = d * d <= radius * radius * 1.001;
  if (surrounds || centre.z + radius <= 0) return std::nullopt;
  const glm::dvec3 v = centre / d;
  const glm::dvec3 reference = std::abs(v.y) > 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(v, reference));
  const double half = radius + pixel * d / 64;
  return Square{.centre = v * ((d - radius) * 0.9990234375),
                .right = right,
                .up = glm::cross(right, v),
                .half = half,
                .grown = half + growth * pixel * std::max(centre.z, 0.0)};
}

}  // namespace

double fragments_of_growth(const scene::ParticleScene& scene, double growth) {
  const Image image(scene);
  double count = 0;
  for (std::size_t i = 0; i < scene.particles->count(); ++i) {
    const auto square = square_of(image.in_camera(scene.particles->spheres[i]), scene.radius(i),
                                  image.pixel(), growth);
    if (square) count += static_cast<double>(image.ring(*square));
  }
  return count;
}

}  // namespace triptych::particles_suite
