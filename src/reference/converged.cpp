// The limit of step → 0. The ray is cut where it crosses planes of voxel centres, between which the
// field is a cubic, and where that cubic passes an entry of the transfer function, between which
// opacity and colour are linear in it. So the integrand is smooth on every piece, the midpoint rule
// on it has an error series in even powers of its length, and after halving all pieces Richardson's
// extrapolation (4·fine − coarse)/3 is of order 4. (The kinks of shading, at a gradient at right
// angles to the ray or on the floor, are not cut at; they leave it at order 2.) The stated bound is
// the change by the last halving, about three times the error even before extrapolation.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

#include "reference/cubic.hpp"
#include "reference/drawing.hpp"
#include "reference/field.hpp"
#include "reference/ray.hpp"
#include "reference/shading.hpp"
#include "reference/table.hpp"
#include "reference/volume.hpp"

namespace triptych::reference {

namespace {

using Rgba = std::array<double, 4>;

// Pieces are halved at most this often: 1/4096 of a cell.
constexpr int most_halvings = 12;

double largest_difference(const Rgba& a, const Rgba& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

template <typename Stored>
class ConvergedRaycaster {
 public:
  ConvergedRaycaster(const scene::VolumeScene& scene, double tolerance, const Field<Stored>& field,
                     const Table& table)
      : scene_(scene),
        tolerance_(tolerance),
        field_(field),
        table_(table),
        rays_(scene, 0.0),
        smallest_spacing_(scene.smallest_spacing()),
        gradient_scale_(gradient_scale(*scene.grid)) {}

  [[nodiscard]] Pixel operator()(int x, int y) {
    const std::optional<Ray> ray = rays_(x, y);
    if (!ray) return {background(), 0.0};
    cut(*ray);
    Rgba fine = integrate(*ray, 1);
    double change = tolerance_;
    for (int halving = 1; halving <= most_halvings; ++halving) {
      const Rgba coarse = fine;
      fine = integrate(*ray, 1 << halving);
      const double previous = change;
      change = largest_difference(fine, coarse);
      if (halving == most_halvings ||
          (halving > 1 && change <= tolerance_ && previous <= tolerance_)) {
        for (std::size_t i = 0; i < 4; ++i) fine[i] += (fine[i] - coarse[i]) / 3.0;
        break;
      }
    }
    return {fine, change};
  }

 private:
  [[nodiscard]] Rgba background() const {
    return {static_cast<double>(scene_.background[0]), static_cast<double>(scene_.background[1]),
            static_cast<double>(scene_.background[2]), static_cast<double>(scene_.background[3])};
  }

  // Distances from the entry between which the integrand is smooth, ascending, both ends included.
  void cut(const Ray& ray) {
    cells_.assign({0.0, ray.length});
    for (int axis = 0; axis < 3; ++axis) {
      const double speed = ray.voxels_per_unit[axis];
      if (speed == 0.0) continue;
      const int size = scene_.grid->size[static_cast<std::size_t>(axis)];
      const double a = ray.entry[axis];
      const double b = a + ray.length * speed;
      const int first = std::max(static_cast<int>(std::floor(std::min(a, b))), 0);
      const int last = std::min(static_cast<int>(std::ceil(std::max(a, b))), size - 1);
      for (int k = first; k <= last; ++k) {
        const double t = (k + 0.5 - a) / speed;
        if (t > 0.0 && t < ray.length) cells_.push_back(t);
      }
    }
    std::sort(cells_.begin(), cells_.end());
    cuts_.clear();
    for (std::size_t i = 0; i + 1 < cells_.size(); ++i) {
      cuts_.push_back(cells_[i]);
      cut_at_knots(ray, cells_[i], cells_[i + 1]);
    }
    cuts_.push_back(cells_.back());
  }

  void cut_at_knots(const Ray& ray, double begin, double end) {
    if (!(end > begin)) return;
    std::array<double, 4> u;
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double t = begin + (end - begin) * static_cast<double>(i) / 3.0;
      u[i] = Table::knot_of(field_.at(ray.entry + t * ray.voxels_per_unit));
    }
    knots_.clear();
    Cubic::through(u).append_knots(knots_);
    for (const double s : knots_) cuts_.push_back(begin + s * (end - begin));
  }

  [[nodiscard]] Rgba integrate(const Ray& ray, int parts) const {
    Rgba sum{};
    double transmittance = 1.0;
    for (std::size_t piece = 0; piece + 1 < cuts_.size() && transmittance > 0.0; ++piece) {
      const double length = (cuts_[piece + 1] - cuts_[piece]) / parts;
      if (length <= 0.0) continue;
      for (int part = 0; part < parts; ++part) {
        const double t = cuts_[piece] + (part + 0.5) * length;
        const glm::dvec3 p = ray.entry + t * ray.voxels_per_unit;
        const Span span = Table::span_of({field_.at(p), 0.0});
        if (table_.transparent(span)) continue;
        Looked looked = table_.look_up(span);
        if (scene_.shading.enabled) {
          shade(looked,
                headlight_cosine(field_, ray, p, gradient_scale_, scene_.shading.gradient_floor, 0),
                scene_.shading, 0);
        }
        const double weight =
            transmittance * step_opacity(looked.alpha, length / smallest_spacing_);
        for (std::size_t i = 0; i < 3; ++i) sum[i] += weight * looked.colour[i];
        sum[3] += weight;
        transmittance -= weight;
      }
    }
    const Rgba behind = background();
    for (std::size_t i = 0; i < 4; ++i) sum[i] += transmittance * behind[i];
    return sum;
  }

  const scene::VolumeScene& scene_;
  double tolerance_;
  const Field<Stored>& field_;
  const Table& table_;
  RayMaker rays_;
  double smallest_spacing_;
  glm::dvec3 gradient_scale_;
  std::vector<double> cells_;
  std::vector<double> knots_;
  std::vector<double> cuts_;
};

}  // namespace

Truth render_volume_converged(const scene::VolumeScene& scene, double tolerance, int threads) {
  check(scene);
  return with_stored_type(scene.grid->format, [&]<typename Stored>(Stored) {
    const Field<Stored> field(*scene.grid, {});
    const Table table(scene.transfer_function, 0.0);
    return draw(scene, threads,
                [&] { return ConvergedRaycaster<Stored>(scene, tolerance, field, table); });
  });
}

}  // namespace triptych::reference
