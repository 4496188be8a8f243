#include "technique/particles/division.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <optional>
#include <utility>

namespace triptych::technique {
namespace {

// Returns the edge length for which about `wanted` cubic cells fill the box. Axes that are too
// short to be divided are ignored.
double edge_for(const glm::dvec3& size, double wanted) {
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

// Four floats, as in a sphere, so that a loop over them compiles to a single SIMD instruction.
// Boxes do not use the fourth float.
using Four = std::array<float, 4>;

struct Box {
  Four lo = filled(std::numeric_limits<float>::infinity());
  Four hi = filled(-std::numeric_limits<float>::infinity());

  void add(const Four& centre, float reach) {
    for (std::size_t k = 0; k < 4; ++k) {
      lo[k] = std::min(lo[k], centre[k] - reach);
      hi[k] = std::max(hi[k], centre[k] + reach);
    }
  }
  void add(const Box& other) {
    for (std::size_t k = 0; k < 4; ++k) {
      lo[k] = std::min(lo[k], other.lo[k]);
      hi[k] = std::max(hi[k], other.hi[k]);
    }
  }
  [[nodiscard]] float size(std::size_t axis) const { return hi[axis] - lo[axis]; }
  // Returns half of the surface area.
  [[nodiscard]] double surface() const {
    const double x = static_cast<double>(size(0));
    const double y = static_cast<double>(size(1));
    const double z = static_cast<double>(size(2));
    return x * y + y * z + z * x;
  }

 private:
  static constexpr Four filled(float value) { return {value, value, value, value}; }
};

// Several spheres and the box around them.
struct Group {
  std::uint32_t count = 0;
  Box box;

  void add(const Group& other) {
    count += other.count;
    box.add(other.box);
  }
  [[nodiscard]] double cost() const { return count == 0 ? 0 : count * box.surface(); }
};

struct Plane {
  std::size_t axis = 0;
  float at = 0;
};

// Along each axis, the search divides the extent of the spheres' centres into 16 equal slices and
// tries the planes between them.
constexpr std::size_t slices = 16;
using SliceGroups = std::array<Group, slices>;

// Returns the plane with the lowest cost, as the index of the slice directly above it, and that
// cost. The index is 0 if no plane costs less than `most`.
std::pair<std::size_t, double> cheapest(const SliceGroups& parts, double most) {
  std::array<double, slices> below_cost{};
  Group below;
  for (std::size_t i = 0; i < slices; ++i) {
    below_cost[i] = below.cost();
    below.add(parts[i]);
  }
  std::pair<std::size_t, double> best{0, most};
  Group above;
  for (std::size_t i = slices - 1; i > 0; --i) {
    above.add(parts[i]);
    const double total = below_cost[i] + above.cost();
    if (total < best.second) best = {i, total};
  }
  return best;
}

class PlaneSearch {
 public:
  PlaneSearch(const scene::ParticleScene& scene, std::span<const std::uint32_t> places) {
    const std::vector<Four>& spheres = scene.particles->spheres;
    for (const std::uint32_t place : places) centres_.add(spheres[place], 0);
    Four slices_per_length{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float size = centres_.size(axis);
      if (size > 0) slices_per_length[axis] = float{slices} / size;
    }
    for (const std::uint32_t place : places) {
      const Four& sphere = spheres[place];
      const float radius = scene.radius(place);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float slice = (sphere[axis] - centres_.lo[axis]) * slices_per_length[axis];
        Group& group = by_axis_[axis][std::min(static_cast<std::size_t>(slice), slices - 1)];
        ++group.count;
        group.box.add(sphere, radius);
      }
    }
  }

  // Returns the plane that saves the most work, or nullopt if no plane saves more than
  // `least_saving` times the surface area of the box around all spheres. (division.hpp defines the
  // cost of a box.)
  [[nodiscard]] std::optional<Plane> best(double least_saving) const {
    Group all;
    for (const Group& group : by_axis_[0]) all.add(group);
    double least = all.cost() - least_saving * all.box.surface();
    std::optional<Plane> best;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [slice, cost] = cheapest(by_axis_[axis], least);
      if (slice == 0) continue;
      least = cost;
      const float share = static_cast<float>(slice) / float{slices};
      best = {axis, centres_.lo[axis] + share * centres_.size(axis)};
    }
    return best;
  }

 private:
  Box centres_;
  std::array<SliceGroups, 3> by_axis_{};
};

}  // namespace

Grid::Grid(const scene::ParticleSet& set, std::size_t per_cell) {
  glm::dvec3 lo(std::numeric_limits<double>::infinity());
  glm::dvec3 hi(-std::numeric_limits<double>::infinity());
  for (const auto& sphere : set.spheres) {
    const glm::dvec3 centre{sphere[0], sphere[1], sphere[2]};
    lo = glm::min(lo, centre);
    hi = glm::max(hi, centre);
  }
  lo_ = lo;
  const glm::dvec3 size = hi - lo;
  const double wanted = static_cast<double>(set.count()) / static_cast<double>(per_cell);
  edge_ = edge_for(size, std::max(wanted, 1.0));
  const auto parts = [&](double length) {
    return static_cast<std::uint32_t>(std::floor(length / edge_)) + 1;
  };
  counts_ = {parts(size.x), parts(size.y), parts(size.z)};
}

std::uint32_t Grid::cell_of(const std::array<float, 4>& sphere) const {
  std::array<std::uint32_t, 3> at{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto index = static_cast<std::size_t>(axis);
    const double place = (static_cast<double>(sphere[index]) - lo_[axis]) / edge_;
    at[index] = std::min(static_cast<std::uint32_t>(std::max(place, 0.0)), counts_[index] - 1);
  }
  return at[0] + counts_[0] * (at[1] + counts_[1] * at[2]);
}

Division::Division(const scene::ParticleScene& scene, std::size_t per_cell)
    : scene_(scene),
      grid_(*scene.particles, per_cell),
      least_saving_(static_cast<double>(per_cell) / 2),
      nodes_(std::size_t{grid_.cells()} + 1) {
  const auto count = static_cast<std::uint32_t>(scene.particles->count());
  // Sorts the indices by grid cell. `ends` contains first the number of particles in each cell,
  // then the index at which the cell begins, and finally the index at which it ends.
  std::vector<std::uint32_t> ends(nodes_.size());
  for (std::uint32_t place = 0; place < count; ++place) ++ends[undivided_part_of(place)];
  std::uint32_t begin = 0;
  for (std::uint32_t& end : ends) begin += std::exchange(end, begin);
  std::vector<std::uint32_t> places(count);
  for (std::uint32_t place = 0; place < count; ++place) {
    places[ends[undivided_part_of(place)]++] = place;
  }
  for (std::uint32_t cell = 1; cell < ends.size(); ++cell) {
    divide({cell, std::span(places).subspan(ends[cell - 1], ends[cell] - ends[cell - 1])});
  }
}

std::uint32_t Division::undivided_part_of(std::uint32_t place) const {
  const bool too_large = 2 * static_cast<double>(scene_.radius(place)) > grid_.edge();
  return too_large ? 0 : grid_.cell_of(scene_.particles->spheres[place]) + 1;
}

std::uint32_t Division::part_of(std::uint32_t place) const {
  std::uint32_t part = undivided_part_of(place);
  while (nodes_[part].axis != Node::whole) {
    const Node& node = nodes_[part];
    const bool above = scene_.particles->spheres[place][node.axis] >= node.plane;
    part = node.below + (above ? 1 : 0);
  }
  return part;
}

void Division::divide(PendingPart all) {
  std::vector<PendingPart> open{all};
  while (!open.empty()) {
    const PendingPart part = open.back();
    open.pop_back();
    // A plane saves less than the cost of this part, which is its number of particles times its
    // surface area. Dividing at most `least_saving_` particles is therefore never worthwhile.
    if (static_cast<double>(part.places.size()) <= least_saving_) continue;
    const std::optional<Plane> plane = PlaneSearch(scene_, part.places).best(least_saving_);
    if (!plane) continue;
    const auto above =
        std::partition(part.places.begin(), part.places.end(), [&](std::uint32_t place) {
          return scene_.particles->spheres[place][plane->axis] < plane->at;
        });
    const auto below = static_cast<std::size_t>(above - part.places.begin());
    if (below == 0 || below == part.places.size()) continue;  // rounding can put all on one side
    const auto child = static_cast<std::uint32_t>(nodes_.size());
    nodes_[part.node] = {
        .axis = static_cast<std::uint32_t>(plane->axis), .plane = plane->at, .below = child};
    nodes_.resize(nodes_.size() + 2);
    open.push_back({child, part.places.first(below)});
    open.push_back({child + 1, part.places.subspan(below)});
  }
}

}  // namespace triptych::technique
