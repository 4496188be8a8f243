#include "reference/open_counts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "reference/cell_rule.hpp"
#include "reference/drawing.hpp"
#include "reference/field.hpp"
#include "reference/opacity.hpp"
#include "reference/preintegrated.hpp"
#include "reference/ray.hpp"
#include "reference/rows.hpp"
#include "reference/table.hpp"

namespace triptych::reference {
namespace {

struct Tally {
  double hits = 0;
  double samples = 0;
  double nonzero = 0;
  double visited = 0;
  double skipped = 0;
  double terminated = 0;
  double total = 0;  // number of samples without skipping

  Tally& operator+=(const Tally& other) {
    hits += other.hits;
    samples += other.samples;
    nonzero += other.nonzero;
    visited += other.visited;
    skipped += other.skipped;
    terminated += other.terminated;
    total += other.total;
    return *this;
  }
};

// The crossings of one ray with the planes between bricks.
class Crossings {
 public:
  Crossings(const BrickPlanes& planes, const Ray& ray) : planes_(planes), ray_(ray) {}

  // Returns whether a device may assign the point p on the ray to either side of a plane.
  [[nodiscard]] bool is_near(const glm::dvec3& p) const {
    if (planes_.edge == 0) return false;
    for (int axis = 0; axis < 3; ++axis) {
      const double place = (p[axis] - planes_.origin) / planes_.edge;
      const double away = std::abs(place - std::round(place)) * planes_.edge;
      if (away <= ray_.position_error[axis]) return true;
    }
    return false;
  }

  // Returns the number of planes that separate two points.
  [[nodiscard]] double between(const glm::dvec3& a, const glm::dvec3& b) const {
    if (planes_.edge == 0) return 0;
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) sum += std::abs(brick(a[axis]) - brick(b[axis]));
    return sum;
  }

  // Returns the number of planes that the ray crosses so close behind the previous plane that the
  // two crossings may coincide on a device. The device's ray is within `position_error` voxels of
  // this ray.
  [[nodiscard]] double ties(double position_error) const {
    if (planes_.edge == 0) return 0;
    struct Crossing {
      double at;
      double error;
    };
    std::vector<Crossing> all;
    for (int axis = 0; axis < 3; ++axis) {
      const double speed = ray_.voxels_per_unit[axis];
      if (speed == 0.0) continue;
      const double error = position_error / std::abs(speed);
      const double begin = ray_.entry[axis];
      const double end = begin + ray_.longest * speed;
      const double last = brick(std::max(begin, end));
      for (double k = brick(std::min(begin, end)) + 1; k <= last; k += 1) {
        all.push_back({(planes_.origin + k * planes_.edge - begin) / speed, error});
      }
    }
    std::sort(all.begin(), all.end(), [](auto& a, auto& b) { return a.at < b.at; });
    double sum = 0;
    for (std::size_t i = 1; i < all.size(); ++i) {
      if (all[i].at - all[i - 1].at <= all[i].error + all[i - 1].error) ++sum;
    }
    return sum;
  }

 private:
  [[nodiscard]] double brick(double p) const {
    return std::floor((p - planes_.origin) / planes_.edge);
  }

  const BrickPlanes& planes_;
  const Ray& ray_;
};

// Determines the samples after which a device may end the ray.
class Stops {
 public:
  explicit Stops(const ErrorModel& model) : model_(model) {}

  void add(const StepOpacity& opacity) {
    const double rounding = model_.compositing_error * largest_;
    largest_ = std::min(largest_ * (1.0 - opacity.lo) + rounding, 1.0);
    smallest_ = std::max(smallest_ * (1.0 - opacity.hi) - rounding, 0.0);
  }
  // Once one of these functions returns true, it returns true for all further samples.
  [[nodiscard]] bool may_end() const { return smallest_ < model_.ert; }
  [[nodiscard]] bool must_end() const { return largest_ < model_.ert; }

 private:
  const ErrorModel& model_;
  double largest_ = 1;
  double smallest_ = 1;
};

// The opacity of a sample on devices. `possible` means that it may have some opacity on a device,
// and `certain` that it has some opacity on every device.
struct SampleOpacity {
  bool possible = false;
  bool certain = false;
  StepOpacity opacity;
};

// Counts the samples, bricks and rays that may differ between devices, for the pixels of one scene.
// Each thread uses its own object.
template <typename Stored>
class Counter {
 public:
  Counter(const scene::VolumeScene& scene, const ErrorModel& model, const BrickPlanes& planes,
          const Field<Stored>& field, const Table& table)
      : scene_(scene),
        model_(model),
        planes_(planes),
        field_(field),
        table_(table),
        rays_(scene, model.position_error_voxels),
        segments_(table, model),
        cells_(scene, model, field, table),
        smallest_spacing_(scene.smallest_spacing()) {}

  [[nodiscard]] Tally operator()(int x, int y) {
    const std::optional<Ray> ray = rays_(x, y);
    if (!ray) return {};
    const Crossings crossings(planes_, *ray);
    const double ties = crossings.ties(model_.position_error_voxels);
    const bool cells = scene_.quadrature == scene::Quadrature::cells;
    Tally tally = cells ? in_cells(*ray, crossings) : on_lattice(*ray, crossings);
    tally.skipped += ties;
    if (cells) tally.visited += ties;  // entering a brick counts as a visit
    if (ray->shortest <= 0 && ray->longest > 0) tally.hits += 1;
    return tally;
  }

 private:
  // Returns the number of steps in a chord, not rounded to an integer.
  [[nodiscard]] double steps(double chord) const {
    return chord / (smallest_spacing_ * scene_.step_voxels);
  }

  [[nodiscard]] Tally on_lattice(const Ray& ray, const Crossings& crossings) const {
    constexpr double division = 8 * 0x1.0p-24;
    const glm::dvec3 stride = ray.voxels_per_unit * scene_.step_world();
    const double fewest = std::ceil(steps(ray.shortest) * (1 - division));
    const double most = std::ceil(steps(ray.longest) * (1 + division));
    Tally tally;
    tally.total = most - fewest;
    Stops stops(model_);
    for (double i = 0; i < most; i += 1) {
      const glm::dvec3 p = ray.entry + (i + 0.5) * stride;
      const bool ended = stops.may_end();  // whether some device may have ended the ray
      const bool open = ended || i >= fewest;
      const SampleOpacity sample = opacity_of_sample(ray, i, stride);
      const bool near = crossings.is_near(p);
      const double passed = open ? crossings.between(p, p + stride) : 0;
      if (open || near) tally.samples += 1;
      if (sample.possible && (open || !sample.certain)) tally.nonzero += 1;
      tally.visited += passed + (near ? 1 : 0);
      tally.skipped += passed + (near ? 1 : 0);
      if (sample.possible) stops.add(sample.opacity);
      if (stops.must_end()) break;
      // A device counts the visits of all bricks in a run of consecutive visible bricks before it
      // draws the run. From this sample on, one device may have ended the ray, while another device
      // may have counted a run that extends to the end of the volume. Therefore all remaining
      // visits may differ.
      if (!ended && stops.may_end()) {
        const double remaining = crossings.between(p, ray.entry + most * stride);
        tally.visited += remaining;
        tally.skipped += remaining;
        tally.terminated += 1;
      }
    }
    return tally;
  }

  [[nodiscard]] SampleOpacity opacity_of_sample(const Ray& ray, double i,
                                                const glm::dvec3& stride) const {
    const StepLength length{part(ray.length, i), part(ray.shortest, i), part(ray.longest, i)};
    return scene_.quadrature == scene::Quadrature::preintegrated
               ? segment_opacity(ray, i, stride, length)
               : point_opacity(ray, ray.entry + (i + 0.5) * stride, length);
  }
  // Returns the length of the i-th step, in voxel lengths.
  [[nodiscard]] double part(double chord, double i) const {
    return std::clamp(chord / smallest_spacing_ - i * scene_.step_voxels, 0.0, scene_.step_voxels);
  }

  [[nodiscard]] SampleOpacity point_opacity(const Ray& ray, const glm::dvec3& p,
                                            const StepLength& length) const {
    const Span span = Table::span_of(field_.at(p, ray.position_error));
    if (table_.transparent(span)) return {};
    const TableLookup lookup = table_.look_up(span);
    return {true, lookup.alpha_lo > 0, step_opacity(lookup, length, model_.opacity_error)};
  }

  [[nodiscard]] SampleOpacity segment_opacity(const Ray& ray, double i, const glm::dvec3& stride,
                                              const StepLength& length) const {
    const double end = std::min(i + 1, std::max(steps(ray.length), i));
    const bool last = i + 1 > steps(ray.shortest);  // the step ends where the ray ends
    const Bounded front = field_.at(ray.entry + i * stride, ray.position_error);
    const Bounded back =
        field_.at(ray.entry + end * stride, ray.position_error_within(last ? ray.slack() : 0.0));
    if (segments_.transparent(front, back)) return {};
    const StepOpacity opacity = segments_(front, back, length).opacity;
    return {true, opacity.lo > 0x1.0p-24, opacity};
  }

  [[nodiscard]] Tally in_cells(const Ray& ray, const Crossings& crossings) {
    Tally tally;
    Stops stops(model_);
    const bool all = ray.shortest <= 0;
    cells_.walk_open(ray, [&](const OpenPoints& points, const StepOpacity& opacity) {
      const bool ended = stops.may_end();
      const bool open = all || ended;
      tally.samples += open ? points.most : points.open;
      tally.nonzero += open ? points.most : points.open + points.maybe_visible;
      const glm::dvec3 a = ray.entry + points.begin * ray.voxels_per_unit;
      const glm::dvec3 b = ray.entry + points.end * ray.voxels_per_unit;
      const double passed = open ? 1 + crossings.between(a, b) : 0;
      tally.visited += passed;
      tally.skipped += passed;
      stops.add(opacity);
      if (!ended && stops.may_end() && !stops.must_end()) tally.terminated += 1;
      return !stops.must_end();
    });
    if (all) tally.visited += 1;  // a device may leave the volume before its first cell
    return tally;
  }

  const scene::VolumeScene& scene_;
  const ErrorModel& model_;
  const BrickPlanes& planes_;
  const Field<Stored>& field_;
  const Table& table_;
  RayMaker rays_;
  Preintegration segments_;
  CellRule<Stored> cells_;
  double smallest_spacing_;
};

template <typename MakeCounter>
Tally sum(const scene::VolumeScene& scene, int threads, const MakeCounter& make_counter) {
  std::vector<Tally> rows(static_cast<std::size_t>(scene.height));
  for_each_row(scene.height, threads, [&]() -> RowWorker {
    auto counter = std::make_shared<decltype(make_counter())>(make_counter());
    return [&rows, &scene, counter](int y) {
      for (int x = 0; x < scene.width; ++x) rows[static_cast<std::size_t>(y)] += (*counter)(x, y);
    };
  });
  Tally total;
  for (const Tally& row : rows) total += row;
  return total;
}

}  // namespace

std::map<std::string, double> open_counts(const scene::VolumeScene& scene, const ErrorModel& model,
                                          const BrickPlanes& planes, int threads) {
  check(scene);
  const Tally tally = with_stored_type(scene.grid->format, [&]<typename Stored>(Stored) {
    const Field<Stored> field(*scene.grid, model);
    const Table table(scene.transfer_function, model.table_error);
    return sum(scene, threads, [&] { return Counter<Stored>(scene, model, planes, field, table); });
  });
  return {{"rays_hit", tally.hits},
          {"samples", tally.samples},
          {"samples_nonzero", tally.nonzero},
          {"bricks_visited", tally.visited},
          {"bricks_skipped", tally.skipped},
          {"rays_terminated", tally.terminated},
          {"samples_saved", tally.total + tally.samples}};
}

}  // namespace triptych::reference
