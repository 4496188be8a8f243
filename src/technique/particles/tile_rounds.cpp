#include "technique/particles/tile_rounds.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace triptych::technique {
namespace {

// Bounds how many tiles spheres may enter.
class EntryBound {
 public:
  explicit EntryBound(const scene::ParticleScene& scene)
      : camera_(scene.camera),
        right_(scene.camera.right()),
        pixel_(2 * std::tan(glm::radians(scene.camera.fov_y_deg) / 2) / scene.height),
        columns_(tiles(scene.width)),
        rows_(tiles(scene.height)) {}

  [[nodiscard]] std::uint64_t of(std::span<const std::array<float, 4>> spheres) const {
    double entries = 0;
    for (const auto& sphere : spheres) entries += of(sphere);
    return static_cast<std::uint64_t>(entries);
  }

 private:
  static double tiles(int pixels) { return std::ceil(static_cast<double>(pixels) / tile_edge); }

  [[nodiscard]] double of(const std::array<float, 4>& sphere) const {
    const glm::dvec3 to = glm::dvec3(sphere[0], sphere[1], sphere[2]) - camera_.eye;
    const double r = static_cast<double>(sphere[3]);
    const double z = glm::dot(to, camera_.forward);
    if (z <= -r) return 0;
    if (z <= r) return columns_ * rows_;
    const double width = extent(glm::dot(to, right_), z, r);
    const double height = extent(glm::dot(to, camera_.up), z, r);
    if (std::max(width, height) < tile_edge) return 0;
    return std::min(columns_, std::floor(width / tile_edge) + 2) *
           std::min(rows_, std::floor(height / tile_edge) + 2);
  }

  // Pixels along one axis between the sphere's two tangents, 2r√(a² + z² − r²)/(z² − r²) on the
  // image plane; two more for the margin and for rounding, which a hundredth covers for z near r.
  [[nodiscard]] double extent(double a, double z, double r) const {
    const double k2 = (z - r) * (z + r);
    return 1.01 * 2 * r * std::sqrt(a * a + k2) / k2 / pixel_ + 2;
  }

  const scene::Camera& camera_;
  glm::dvec3 right_;
  double pixel_;
  double columns_;
  double rows_;
};

}  // namespace

TileRounds tile_rounds(const scene::ParticleScene& scene, const Arrangement& arrangement,
                       std::uint32_t most_cells, std::uint64_t most_entries) {
  constexpr std::size_t first_particles = 32 * particles_per_cell;
  const EntryBound bound(scene);
  TileRounds out;
  std::size_t wanted = first_particles;
  std::size_t particles = 0;
  std::uint64_t entries = 0;
  TileRound round;
  const auto finish = [&] {
    if (round.cells == 0) return;
    out.rounds.push_back(round);
    out.entries = std::max(out.entries, entries);
    round = {round.first + round.cells, 0};
    if (particles >= wanted) wanted *= 2;
    particles = 0;
    entries = 0;
  };
  for (const Cell& cell : arrangement.cells) {
    const std::uint64_t more =
        bound.of(std::span(arrangement.spheres).subspan(cell.begin, cell.count));
    if (entries + more > most_entries || round.cells == most_cells) finish();
    ++round.cells;
    particles += cell.count;
    entries += more;
    if (particles >= wanted) finish();
  }
  finish();
  return out;
}

}  // namespace triptych::technique
