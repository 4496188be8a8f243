#include "suites/particles/plain_work.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "scene/camera.hpp"
#include "scene/particles.hpp"
#include "technique/catalogue.hpp"

namespace triptych::particles_suite {
namespace {

// A rectangle of pixels in the image. The upper limits are exclusive.
struct Rectangle {
  int x_lo, x_hi, y_lo, y_hi;
};

// One axis of the image: its start on the image plane, the pixels per unit of length there, and its
// number of pixels.
struct Axis {
  double first;
  double per_unit;
  int pixels;

  // Returns the range of pixels that a ball of radius r can cover along this axis. Its centre lies
  // at `a` along this axis and at `z` along the view axis, so it appears at a/z on the image plane.
  // Every other point of the ball appears at a distance of at most r·(1 + |a|/z)/(z − r) from
  // there. Two pixels are added on each side, which is more than the margin of any sprite.
  [[nodiscard]] std::pair<int, int> pixels_of(double a, double z, double r) const {
    constexpr double margin = 2;
    const double middle = (a / z - first) * per_unit;
    const double half = r * (1 + std::abs(a) / z) / (z - r) * per_unit + margin;
    const auto inside = [&](double x) {
      return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(pixels)));
    };
    return {inside(std::floor(middle - half)), inside(std::ceil(middle + half))};
  }
};

// Records which pixels have been claimed by sprites.
class Claims {
 public:
  Claims(int width, int height)
      : width_(static_cast<std::size_t>(width)),
        claimed_(width_ * static_cast<std::size_t>(height), false) {}

  // Claims all pixels of the rectangle. Returns false if another sprite has already claimed one of
  // them.
  bool claim(const Rectangle& rectangle) {
    for (int y = rectangle.y_lo; y < rectangle.y_hi; ++y) {
      for (int x = rectangle.x_lo; x < rectangle.x_hi; ++x) {
        const std::size_t at = static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x);
        if (claimed_[at]) return false;
        claimed_[at] = true;
      }
    }
    return true;
  }

 private:
  std::size_t width_;
  std::vector<bool> claimed_;
};

}  // namespace

bool sprites_are_apart(const scene::ParticleScene& scene) {
  // An upper bound on the distance of a sprite's corners from its centre, in radii of the sphere. A
  // sprite is a polygon around the silhouette with at least four corners, so the corners are at
  // most √2 times as far from the centre as the silhouette. The factor 1.05 is a margin.
  constexpr double reach = 1.05 * std::numbers::sqrt2;
  const double tangent = scene::tangent_of_half(scene.camera.fov_y_deg);
  const double aspect = static_cast<double>(scene.width) / scene.height;
  const Axis across{-aspect * tangent, scene.width / (2 * aspect * tangent), scene.width};
  const Axis down{-tangent, scene.height / (2 * tangent), scene.height};
  const glm::dvec3 right = scene.camera.right();
  Claims claims(scene.width, scene.height);
  for (std::size_t i = 0; i < scene.particles->count(); ++i) {
    const auto& sphere = scene.particles->spheres[i];
    const glm::dvec3 from_eye = glm::dvec3(sphere[0], sphere[1], sphere[2]) - scene.camera.eye;
    const double z = glm::dot(from_eye, scene.camera.forward);
    const double r = reach * static_cast<double>(scene.radius(i));
    if (z < -r) continue;
    if (z < 2 * r) return false;
    const auto [x_lo, x_hi] = across.pixels_of(glm::dot(from_eye, right), z, r);
    const auto [y_lo, y_hi] = down.pixels_of(-glm::dot(from_eye, scene.camera.up), z, r);
    if (!claims.claim({x_lo, x_hi, y_lo, y_hi})) return false;
  }
  return true;
}

measure::PlainWork plain_work(const measure::Configuration& configuration,
                              const measure::ParticleWork& work) {
  measure::PlainWork plain{.levels = configuration};
  const auto simplify = [&](const std::string& factor, const std::string& level, const char* why) {
    std::string& current = plain.levels.at(factor);
    if (current == level) return;
    current = level;
    plain.why[factor] = why;
  };
  const technique::Technique& technique = technique::technique(configuration.at("technique"));
  if (configuration.at("colour") != "intensity") {
    simplify("transfer", "vertex", "stored colours need no transfer function");
    simplify("transfer_function", "haze", "stored colours need no transfer function");
  }
  if (!technique.uses_corners) simplify("corners", "8", "only polygon_tess uses this factor");
  if (technique.method == technique::Method::rays) {
    simplify("conservative_depth", "off", "rays always skip spheres that are hidden");
    simplify("culling", "frustum", "rays always skip spheres that they cannot hit");
    return plain;
  }
  if (work.options.conservative_depth) {
    if (technique.method == technique::Method::tiles) {
      simplify("conservative_depth", "off",
               "the technique 'tiles' always rejects spheres by the depth of their nearest point");
    } else if (sprites_are_apart(work.scene)) {
      simplify("conservative_depth", "off", "no sprite lies behind another");
    }
  }
  return plain;
}

}  // namespace triptych::particles_suite
