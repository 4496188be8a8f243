#include "technique/particles/arrangement.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <utility>

#include "technique/particles/division.hpp"

namespace triptych::technique {
namespace {

// Returns the particles' indices in the set, sorted by id, or an empty vector if the set is already
// sorted.
std::vector<std::uint32_t> by_id(const scene::ParticleSet& set) {
  std::vector<std::uint32_t> places;
  if (std::ranges::is_sorted(set.ids)) return places;
  places.resize(set.count());
  std::iota(places.begin(), places.end(), 0U);
  std::ranges::sort(places, {}, [&](std::uint32_t i) { return set.ids[i]; });
  return places;
}

// The maximum number of particles in a cell. A larger cell is split into several cells, so that a
// crowded region is divided even where no plane can separate its particles.
constexpr std::uint32_t longest_run = 4 * particles_per_cell;

// The particles of one part of space (division.hpp), or some of them if there are more than
// `longest_run`, in ascending order of their ids. Each run becomes a cell of the arrangement. lo
// and hi are the corners of the box around the spheres.
struct Run {
  glm::vec3 lo{std::numeric_limits<float>::infinity()};
  glm::vec3 hi{-std::numeric_limits<float>::infinity()};
  std::uint32_t count = 0;
  std::uint32_t begin = 0;  // index of its first particle in the arrangement
};

// Divides the particles into runs, which become the cells of the arrangement. Every pass over the
// particles recomputes to which run each particle belongs, because storing the index of the run for
// each particle would take as much memory as the drawing order itself.
class Runs {
 public:
  explicit Runs(const scene::ParticleScene& scene)
      : scene_(scene),
        set_(*scene.particles),
        division_(scene, particles_per_cell),
        by_id_(by_id(set_)) {
    make_runs();
    measure();
    sort_front_to_back();
  }

  [[nodiscard]] std::vector<Cell> cells() const {
    std::vector<Cell> cells;
    cells.reserve(runs_.size());
    for (const std::uint32_t i : front_to_back_) {
      const Run& run = runs_[i];
      cells.push_back({.lo = {run.lo.x, run.lo.y, run.lo.z},
                       .begin = run.begin,
                       .hi = {run.hi.x, run.hi.y, run.hi.z},
                       .count = run.count});
    }
    return cells;
  }

  // Returns the particles' indices in the set, one run after the other.
  [[nodiscard]] std::vector<std::uint32_t> order() {
    std::vector<std::uint32_t> order(set_.count());
    for_each([&](std::uint32_t place, Run& run) { order[run.begin + run.count++] = place; });
    return order;
  }

 private:
  // Calls visit(place, run) for each particle in ascending order of id, where `place` is the index
  // of the particle in the set. Run::count is 0 at first, and `visit` must increment it for each
  // particle.
  template <typename Visit>
  void for_each(const Visit& visit) {
    for (Run& run : runs_) run.count = 0;
    std::vector<std::uint32_t> filling = first_run_;
    for (std::uint32_t i = 0; i < set_.count(); ++i) {
      const std::uint32_t place = by_id_.empty() ? i : by_id_[i];
      std::uint32_t& run = filling[division_.part_of(place)];
      if (runs_[run].count == longest_run) ++run;
      visit(place, runs_[run]);
    }
  }

  // Creates the runs of all parts of space. A part with more than `longest_run` particles gets
  // several runs.
  void make_runs() {
    first_run_.resize(division_.parts());
    for (std::uint32_t place = 0; place < set_.count(); ++place) {
      ++first_run_[division_.part_of(place)];
    }
    std::uint32_t runs = 0;
    for (std::uint32_t& entry : first_run_) {
      const std::uint32_t needed = (entry + longest_run - 1) / longest_run;
      entry = std::exchange(runs, runs + needed);
      if (&entry == &first_run_.front()) large_ = needed;
    }
    runs_.resize(runs);
  }

  // Computes the number of particles and the box of each run.
  void measure() {
    for_each([&](std::uint32_t place, Run& run) {
      const auto& sphere = set_.spheres[place];
      const glm::vec3 centre{sphere[0], sphere[1], sphere[2]};
      const float r = scene_.radius(place);
      run.lo = glm::min(run.lo, centre - r);
      run.hi = glm::max(run.hi, centre + r);
      ++run.count;
    });
    // Rounding may have moved centre ± r inwards by up to half an ulp, so each bound is moved
    // outwards by one ulp.
    for (Run& run : runs_) {
      for (int axis = 0; axis < 3; ++axis) {
        run.lo[axis] = std::nextafter(run.lo[axis], -std::numeric_limits<float>::infinity());
        run.hi[axis] = std::nextafter(run.hi[axis], std::numeric_limits<float>::infinity());
      }
    }
  }

  [[nodiscard]] double distance_of(const Run& run) const {
    const glm::dvec3& eye = scene_.camera.eye;
    return glm::distance(eye, glm::clamp(eye, glm::dvec3(run.lo), glm::dvec3(run.hi)));
  }

  // Sorts the runs, which are groups of particles. Runs with large spheres stay at the front. Every
  // other run is in a part of space that may contain several runs. Runs are sorted by the distance
  // of their part from the eye, and runs of the same part stay in order. Coincident spheres are in
  // the same part, so the one with the lowest id is drawn first.
  void sort_front_to_back() {
    std::vector<double> distances(runs_.size());
    for (std::size_t part = 0; part < first_run_.size(); ++part) {
      const std::size_t end = part + 1 < first_run_.size() ? first_run_[part + 1] : runs_.size();
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t i = first_run_[part]; i < end; ++i) {
        nearest = std::min(nearest, distance_of(runs_[i]));
      }
      for (std::size_t i = first_run_[part]; i < end; ++i) distances[i] = nearest;
    }
    front_to_back_.resize(runs_.size());
    std::iota(front_to_back_.begin(), front_to_back_.end(), 0U);
    std::ranges::stable_sort(front_to_back_.begin() + large_, front_to_back_.end(), {},
                             [&](std::uint32_t i) { return distances[i]; });
    std::uint32_t begin = 0;
    for (const std::uint32_t i : front_to_back_) {
      runs_[i].begin = std::exchange(begin, begin + runs_[i].count);
    }
  }

  const scene::ParticleScene& scene_;
  const scene::ParticleSet& set_;
  Division division_;
  std::vector<std::uint32_t> by_id_;
  std::vector<std::uint32_t> first_run_;  // indexed by part
  std::vector<Run> runs_;                 // sorted by part, then id
  std::ptrdiff_t large_ = 0;              // number of runs with large spheres, which come first
  std::vector<std::uint32_t> front_to_back_;
};

// Fills `out` with value(first), value(first + 1), and so on. Uses memcpy, because `out` may be
// unaligned.
template <typename Value>
void write(std::size_t first, std::span<std::byte> out, const Value& value) {
  using Element = decltype(value(std::size_t{}));
  const std::size_t count = out.size() / sizeof(Element);
  for (std::size_t i = 0; i < count; ++i) {
    const Element element = value(first + i);
    std::memcpy(out.data() + i * sizeof(Element), &element, sizeof(Element));
  }
}

void copy_colours(const Arrangement& from, std::size_t first, std::span<std::byte> out) {
  const scene::ParticleSet& set = *from.particles;
  const auto gather = [&](const auto& values) {
    write(first, out, [&](std::size_t k) { return values[from.order[k]]; });
  };
  switch (set.colour) {
    case scene::ColourKind::rgba8:
      return gather(set.rgba8);
    case scene::ColourKind::rgba32:
      return gather(set.rgba32);
    case scene::ColourKind::intensity:
      return gather(set.intensity);
  }
}

}  // namespace

std::size_t Arrangement::element_bytes(Property property) const {
  const bool four =
      property == Property::sphere ||
      (property == Property::colour && particles->colour == scene::ColourKind::rgba32);
  return (four ? 4 : 1) * sizeof(float);
}

void Arrangement::copy(Property property, std::size_t begin, std::span<std::byte> out) const {
  const std::size_t first = begin / element_bytes(property);
  switch (property) {
    case Property::sphere:
      return write(first, out, [&](std::size_t k) { return sphere(k); });
    case Property::colour:
      return copy_colours(*this, first, out);
    case Property::id:
      return write(first, out, [&](std::size_t k) { return id(k); });
  }
}

Arrangement arrange(const scene::ParticleScene& scene) {
  Arrangement out{.particles = scene.particles, .radius_scale = scene.radius_scale};
  if (scene.particles->count() == 0) return out;
  Runs runs(scene);
  out.cells = runs.cells();
  out.order = runs.order();
  return out;
}

}  // namespace triptych::technique
