#include "technique/particles/arrangement.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <utility>

namespace triptych::technique {
namespace {

// A regular grid over the centres, of about cubic cells.
class Grid {
 public:
  explicit Grid(const scene::ParticleSet& set) {
    glm::dvec3 lo(std::numeric_limits<double>::infinity());
    glm::dvec3 hi(-std::numeric_limits<double>::infinity());
    for (const auto& sphere : set.spheres) {
      const glm::dvec3 centre{sphere[0], sphere[1], sphere[2]};
      lo = glm::min(lo, centre);
      hi = glm::max(hi, centre);
    }
    lo_ = lo;
    const glm::dvec3 size = hi - lo;
    const double wanted = static_cast<double>(set.count()) / particles_per_cell;
    edge_ = edge_for(size, std::max(wanted, 1.0));
    const auto parts = [&](double length) {
      return static_cast<std::uint32_t>(std::floor(length / edge_)) + 1;
    };
    counts_ = {parts(size.x), parts(size.y), parts(size.z)};
  }

  [[nodiscard]] double edge() const { return edge_; }
  [[nodiscard]] std::size_t cells() const {
    return std::size_t{counts_[0]} * counts_[1] * counts_[2];
  }
  [[nodiscard]] std::uint32_t cell_of(const std::array<float, 4>& sphere) const {
    std::array<std::uint32_t, 3> at{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto index = static_cast<std::size_t>(axis);
      const double place = (static_cast<double>(sphere[index]) - lo_[axis]) / edge_;
      at[index] = std::min(static_cast<std::uint32_t>(std::max(place, 0.0)), counts_[index] - 1);
    }
    return at[0] + counts_[0] * (at[1] + counts_[1] * at[2]);
  }

 private:
  // The edge at which about `wanted` cells fill the box; axes too short to be divided do not count.
  static double edge_for(const glm::dvec3& size, double wanted) {
    const double longest = std::max({size.x, size.y, size.z});
    if (!(longest > 0)) return 1;
    double low = longest / 2e6;
    double high = 2 * longest;
    for (int i = 0; i < 60; ++i) {
      const double middle = std::sqrt(low * high);
      const glm::dvec3 parts = glm::floor(size / middle) + 1.0;
      (parts.x * parts.y * parts.z > wanted ? low : high) = middle;
    }
    return high;
  }

  glm::dvec3 lo_{};
  double edge_ = 1;
  std::array<std::uint32_t, 3> counts_{1, 1, 1};
};

// Indices into the set, ascending by id.
std::vector<std::uint32_t> by_id(const scene::ParticleSet& set) {
  std::vector<std::uint32_t> order(set.count());
  std::iota(order.begin(), order.end(), 0U);
  if (!std::ranges::is_sorted(set.ids)) {
    std::ranges::sort(order, {}, [&](std::uint32_t i) { return set.ids[i]; });
  }
  return order;
}

// The particles of one cell of the grid, or a part of them, in the order `sorted`.
struct Run {
  Cell cell;  // begin is the place in `sorted`
  double distance = 0;
};

Run run_of(const scene::ParticleScene& scene, const std::vector<std::uint32_t>& sorted,
           std::size_t begin, std::size_t end) {
  glm::vec3 lo(std::numeric_limits<float>::infinity());
  glm::vec3 hi(-std::numeric_limits<float>::infinity());
  for (std::size_t i = begin; i < end; ++i) {
    const auto& sphere = scene.particles->spheres[sorted[i]];
    const glm::vec3 centre{sphere[0], sphere[1], sphere[2]};
    const float r = scene.radius(sorted[i]);
    lo = glm::min(lo, centre - r);
    hi = glm::max(hi, centre + r);
  }
  // centre ± r is rounded to nearest: one float further out is outside for certain.
  for (int axis = 0; axis < 3; ++axis) {
    lo[axis] = std::nextafter(lo[axis], -std::numeric_limits<float>::infinity());
    hi[axis] = std::nextafter(hi[axis], std::numeric_limits<float>::infinity());
  }
  const glm::dvec3& eye = scene.camera.eye;
  return {.cell = {.lo = {lo.x, lo.y, lo.z},
                   .begin = static_cast<std::uint32_t>(begin),
                   .hi = {hi.x, hi.y, hi.z},
                   .count = static_cast<std::uint32_t>(end - begin)},
          .distance = glm::distance(eye, glm::clamp(eye, glm::dvec3(lo), glm::dvec3(hi)))};
}

// A cell with more particles than this becomes several, so that one crowded place stays divisible.
constexpr std::size_t longest_run = 4 * particles_per_cell;

// Sorts `order` by cell, keeping the order within each (a counting sort), and names the runs; the
// first `large` ones hold the particles that are too large for a cell.
std::vector<Run> sort_into_runs(const scene::ParticleScene& scene,
                                std::vector<std::uint32_t>& order, std::size_t& large) {
  const scene::ParticleSet& set = *scene.particles;
  const Grid grid(set);
  std::vector<std::uint32_t> keys(set.count());
  std::vector<std::uint32_t> ends(grid.cells() + 2);
  for (std::uint32_t i = 0; i < set.count(); ++i) {
    const bool too_large = 2 * static_cast<double>(scene.radius(i)) > grid.edge();
    keys[i] = too_large ? 0 : grid.cell_of(set.spheres[i]) + 1;
    ++ends[keys[i] + 1];
  }
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<std::uint32_t> sorted(set.count());
  for (const std::uint32_t i : order) sorted[ends[keys[i]]++] = i;
  order = std::move(sorted);
  std::vector<Run> runs;
  for (std::size_t begin = 0, key = 0; key <= grid.cells(); ++key) {
    for (const std::size_t end = ends[key]; begin < end;) {
      const std::size_t next = std::min(end, begin + longest_run);
      runs.push_back(run_of(scene, order, begin, next));
      begin = next;
    }
    if (key == 0) large = runs.size();
  }
  return runs;
}

// The particles of `order`, run after run, and the runs with their places therein.
std::vector<std::uint32_t> run_by_run(const std::vector<std::uint32_t>& order,
                                      std::vector<Run>& runs) {
  std::vector<std::uint32_t> result;
  result.reserve(order.size());
  for (Run& run : runs) {
    const auto begin = order.begin() + run.cell.begin;
    run.cell.begin = static_cast<std::uint32_t>(result.size());
    result.insert(result.end(), begin, begin + run.cell.count);
  }
  return result;
}

// One property of the particles in that order; nothing where the set has none of it.
template <typename Value>
std::vector<Value> gathered(const std::vector<Value>& values,
                            const std::vector<std::uint32_t>& order) {
  std::vector<Value> result;
  if (values.empty()) return result;
  result.reserve(order.size());
  for (const std::uint32_t i : order) result.push_back(values[i]);
  return result;
}

std::vector<std::array<float, 4>> spheres_as_drawn(const scene::ParticleScene& scene,
                                                   const std::vector<std::uint32_t>& order) {
  std::vector<std::array<float, 4>> result = gathered(scene.particles->spheres, order);
  for (std::size_t k = 0; k < order.size(); ++k) result[k][3] = scene.radius(order[k]);
  return result;
}

// In the memory of the order, which is of no more use then.
std::vector<std::uint32_t> ids_in_place_of(std::vector<std::uint32_t> order,
                                           const scene::ParticleSet& set) {
  for (std::uint32_t& place : order) place = set.ids[place];
  return order;
}

}  // namespace

Arrangement arrange(const scene::ParticleScene& scene) {
  const scene::ParticleSet& set = *scene.particles;
  Arrangement out{.colour = set.colour};
  if (set.count() == 0) return out;
  std::vector<std::uint32_t> order = by_id(set);
  std::size_t large = 0;
  std::vector<Run> runs = sort_into_runs(scene, order, large);
  std::stable_sort(runs.begin() + static_cast<std::ptrdiff_t>(large), runs.end(),
                   [](const Run& a, const Run& b) { return a.distance < b.distance; });
  order = run_by_run(order, runs);
  out.cells.reserve(runs.size());
  for (const Run& run : runs) out.cells.push_back(run.cell);
  out.spheres = spheres_as_drawn(scene, order);
  out.rgba8 = gathered(set.rgba8, order);
  out.rgba32 = gathered(set.rgba32, order);
  out.intensity = gathered(set.intensity, order);
  out.ids = ids_in_place_of(std::move(order), set);
  return out;
}

}  // namespace triptych::technique
