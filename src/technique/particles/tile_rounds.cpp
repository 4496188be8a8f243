#include "technique/particles/tile_rounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "scene/camera.hpp"

namespace triptych::technique {
namespace {

// Upper bounds on the resources required by a number of spheres.
struct Need {
  double pixels = 0;   // number of pixels that are drawn
  double entries = 0;  // number of (tile, large sphere) pairs
  std::uint64_t large = 0;
  bool small = false;  // whether some sphere may be small
  // The maximum number of loop iterations in one invocation. The loops run over the pixels of small
  // spheres and the tiles of large spheres.
  double passes = 0;

  void add(const Need& more) {
    pixels += more.pixels;
    entries += more.entries;
    large += more.large;
    small = small || more.small;
    passes = std::max(passes, more.passes);
  }
};

class NeedBound {
 public:
  explicit NeedBound(const scene::ParticleScene& scene)
      : camera_(scene.camera),
        right_(scene.camera.right()),
        half_y_(scene::tangent_of_half(scene.camera.fov_y_deg)),
        half_x_(half_y_ * scene.width / scene.height),
        pixel_(2 * half_y_ / scene.height),
        columns_(tiles(scene.width)),
        rows_(tiles(scene.height)) {}

  [[nodiscard]] Need of(const Arrangement& arrangement, const Cell& cell) const {
    Need all;
    // The number of loop iterations of each invocation in a work group of tiles_bin.
    std::array<double, 64> passes{};
    for (std::size_t k = 0; k < cell.count; ++k) {
      const Need need = of(arrangement.sphere(cell.begin + k));
      all.add(need);
      // The entries of a sphere (one for each tile that it reaches) count twice, because an
      // invocation of tiles_fill may process two spheres.
      all.passes = std::max(all.passes, 2 * need.entries);
      passes[k % passes.size()] += 1 + need.entries + (need.small ? small_edge * small_edge : 0);
    }
    all.passes = std::max(all.passes, *std::ranges::max_element(passes));
    return all;
  }

 private:
  static double tiles(int pixels) { return std::ceil(static_cast<double>(pixels) / tile_edge); }

  [[nodiscard]] Need of(const std::array<float, 4>& sphere) const {
    const glm::dvec3 to = glm::dvec3(sphere[0], sphere[1], sphere[2]) - camera_.eye;
    const double r = static_cast<double>(sphere[3]);
    const double z = glm::dot(to, camera_.forward);
    if (z <= -r) return {};
    double columns = columns_;
    double rows = rows_;
    double pixels = double{tile_edge} * tile_edge * columns * rows;
    bool small = true;  // perhaps only a small part of the sphere is visible
    if (z > 1.001 * r) {
      const double width = extent(glm::dot(to, right_), z, r, half_x_);
      const double height = extent(glm::dot(to, camera_.up), z, r, half_y_);
      if (width <= 0 || height <= 0) return {};
      if (std::max(width, height) < small_edge) return {.pixels = width * height, .small = true};
      pixels = width * height;
      small = std::max(width, height) < small_edge + slack;
      columns = std::min(columns, std::floor(width / tile_edge) + 2);
      rows = std::min(rows, std::floor(height / tile_edge) + 2);
    }
    return {.pixels = pixels, .entries = columns * rows, .large = 1, .small = small};
  }

  // Returns the number of pixels along one axis of the image that a sphere may cover. r is its
  // radius, a the coordinate of its centre along this axis, and z its distance along the view axis.
  // The two tangents of the sphere intersect the image plane, which is at distance 1 from the eye,
  // at (a·z ± r·√(a² + z² − r²))/(z² − r²). This interval is clipped to the image, which extends
  // from −half to half. Three pixels are added for the margin of 1/64 pixel around the sphere and
  // for rounding. The result therefore exceeds the size of a small sphere by less than `slack`. The
  // result is not positive if the sphere is not visible.
  [[nodiscard]] double extent(double a, double z, double r, double half) const {
    const double k2 = (z - r) * (z + r);
    const double reach = r * std::sqrt(a * a + k2);
    const double low = std::max((a * z - reach) / k2, -half);
    const double high = std::min((a * z + reach) / k2, half);
    return (high - low) / pixel_ + 3;
  }
  static constexpr double slack = 6;

  const scene::Camera& camera_;
  glm::dvec3 right_;
  double half_y_;
  double half_x_;
  double pixel_;
  double columns_;
  double rows_;
};

}  // namespace

TileRounds tile_rounds(const scene::ParticleScene& scene, const Arrangement& arrangement,
                       std::uint32_t most_cells, std::uint64_t most_entries) {
  const double pixels = static_cast<double>(scene.width) * scene.height;
  const NeedBound bound(scene);
  TileRounds out;
  TileRound round;
  Need need;           // needs of the current round
  double covered = 0;  // number of pixels of all previous rounds
  const auto finish = [&] {
    if (round.cells == 0) return;
    round.entries = static_cast<std::uint64_t>(need.entries);
    out.rounds.push_back(round);
    out.entries = std::max(out.entries, round.entries);
    out.small = out.small || need.small;
    out.passes = std::max(out.passes, static_cast<std::uint64_t>(need.passes));
    covered += need.pixels;
    round = {.first = round.first + round.cells};
    need = {};
  };
  for (const Cell& cell : arrangement.cells) {
    const Need more = bound.of(arrangement, cell);
    if (need.pixels >= std::max(pixels, covered / 2) || round.cells == most_cells ||
        need.entries + more.entries > static_cast<double>(most_entries) ||
        need.large + more.large > most_large_spheres) {
      finish();
    }
    ++round.cells;
    need.add(more);
  }
  finish();
  constexpr double few = 2;  // number of spheres that cover a pixel, on average
  out.at_once = out.rounds.size() == 1 && covered <= few * pixels;
  return out;
}

std::optional<std::string> passes_reason(const TileRounds& rounds) {
  constexpr std::uint64_t most = 65'000;
  if (rounds.passes <= most) return std::nullopt;
  return fmt::format(
      "the technique 'tiles' would need {} loop iterations in one invocation because the spheres "
      "cover many tiles, and some drivers silently end such long loops; use a smaller viewport or "
      "another technique",
      rounds.passes);
}

}  // namespace triptych::technique
