// Computes the limit of the image for step → 0. The ray is cut at the planes of voxel centres.
// Between these planes, the field along the ray is a cubic polynomial. The ray is also cut where
// this cubic passes an entry of the transfer function. Between two entries, opacity and colour are
// linear in the cubic. Central differences reach from p − 1 to p + 1, so the gradient g is also a
// cubic between the same planes. With shading, the ray is also cut where g is perpendicular to the
// ray direction d and where |g| passes the gradient floor, which are the roots of g·d and of
// |g|² − floor². The integrand is therefore smooth on every piece, and the three-point Gauss rule
// has order 6 there. A piece is halved until halving changes its light by no more than the piece's
// share of the tolerance. The reported bound is the sum of the changes that the last halvings
// caused. Halving leaves 1/64 of the error of a rule of order 6, so the bound is about sixty times
// the error of the result.

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
#include "reference/piece_of_ray.hpp"
#include "reference/polynomial.hpp"
#include "reference/ray.hpp"
#include "reference/shading.hpp"
#include "reference/table.hpp"
#include "reference/volume.hpp"

namespace triptych::reference {

namespace {

using Rgba = std::array<double, 4>;

// The maximum number of times that a piece is halved. Only pieces on which opacity reaches 1 come
// close to this limit.
constexpr int most_halvings = 48;
// The extinction per voxel length that represents opacity 1. With this extinction, 1e-10 of a voxel
// hides everything behind it.
constexpr double most_extinction = 1e12;
// A change that is smaller than this is attributed to rounding.
constexpr double least_tolerance = 0x1.0p-48;

// The part of the ray between two adjacent planes of voxel centres. The position s along it runs
// from 0 to 1.
struct Cell {
  double length = 0;              // in voxel lengths
  Cubic knot;                     // values along the ray, as positions in the table
  std::array<Cubic, 3> gradient;  // only with shading
};

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
    pixel_ = {};
    sum_ = {};
    if (ray) add_cells(*ray);
    const Rgba behind = background();
    const double left = std::exp(-sum_.depth);
    for (std::size_t i = 0; i < 3; ++i) pixel_.rgba[i] = sum_.colour[i] + left * behind[i];
    pixel_.rgba[3] = sum_.opacity() + left * behind[3];
    return pixel_;
  }

 private:
  [[nodiscard]] Rgba background() const {
    return {static_cast<double>(scene_.background[0]), static_cast<double>(scene_.background[1]),
            static_cast<double>(scene_.background[2]), static_cast<double>(scene_.background[3])};
  }

  void add_cells(const Ray& ray) {
    cut_at_planes(ray, scene_.grid->size, planes_);
    share_per_voxel_ = tolerance_ * smallest_spacing_ / ray.length;
    for (std::size_t i = 0; i + 1 < planes_.size() && !dark(); ++i) {
      if (planes_[i + 1] > planes_[i]) add_cell(ray, planes_[i], planes_[i + 1]);
    }
  }

  void add_cell(const Ray& ray, double begin, double end) {
    const auto along = [&](const auto& value) { return Cubic::along(ray, begin, end, value); };
    Cell cell{.length = (end - begin) / smallest_spacing_,
              .knot = along([&](const glm::dvec3& p) { return Table::knot_of(field_.at(p)); }),
              .gradient = {}};
    cuts_.assign({0.0});
    // A cut between two transparent intervals of the table would change nothing, because both
    // pieces are left out.
    cell.knot.append_knots(cuts_, [&](double knot) {
      return !table_.transparent({knot, std::max(knot - 1.0, 0.0), std::min(knot + 1.0, 255.0)});
    });
    cuts_.push_back(1.0);
    if (all_transparent(cell)) return;
    if (scene_.shading.enabled) {
      for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 unit{0.0};
        unit[axis] = 1.0;
        cell.gradient[static_cast<std::size_t>(axis)] = along([&](const glm::dvec3& p) {
          return 0.5 * gradient_scale_[axis] * (field_.at(p + unit) - field_.at(p - unit));
        });
      }
      cut_at_kinks(cell, ray.direction);
    }
    for (std::size_t i = 0; i + 1 < cuts_.size() && !dark(); ++i) {
      if (cuts_[i + 1] > cuts_[i] && !transparent(cell, cuts_[i], cuts_[i + 1])) {
        add_piece(cell, ray.direction, cuts_[i], cuts_[i + 1]);
      }
    }
  }

  // Adds the light of the piece between two cuts.
  void add_piece(const Cell& cell, const glm::dvec3& direction, double begin, double end) {
    const double entry = std::floor(std::clamp(cell.knot(0.5 * (begin + end)), 0.0, 254.0));
    const Rgba lower = table_.at(entry);
    const Rgba upper = table_.at(entry + 1.0);
    const auto point_at = [&](double s) {
      // f is the position between the two entries. The ray is cut where the value passes an entry,
      // but a cut has a position error of 2⁻⁴⁰, which can create a sliver of this length that does
      // not exist. If f were 0 or 1 on the sliver, and the entry there had opacity 1, the sliver
      // would hide everything behind it. The margin keeps f away from 0 and 1. Between an opaque
      // entry and one that is not opaque, it thereby limits the extinction to a few dozen per voxel
      // length, with which so short a sliver absorbs nearly nothing.
      constexpr double margin = 0x1.0p-44;
      const double f = std::clamp(cell.knot(s) - entry, margin, 1.0 - margin);
      Rgba rgba;
      for (std::size_t i = 0; i < 4; ++i) rgba[i] = lower[i] + f * (upper[i] - lower[i]);
      return point(cell, direction, s, rgba);
    };
    const auto light = [&](double a, double b) {
      pixel_.samples += 3;
      return gauss_light(cell.length * (b - a),
                         [&](double share) { return point_at(a + share * (b - a)); });
    };
    add(light, cell.length, begin, end, light(begin, end), 0);
  }

  // Returns whether everything behind the current point is invisible, regardless of the tolerance.
  [[nodiscard]] bool dark() const { return sum_.depth > 60.0; }

  // Returns whether the piece from a to b is transparent. Testing its middle is sufficient, because
  // the piece is between two cuts: either the same two entries are interpolated everywhere, or all
  // entries are transparent.
  [[nodiscard]] bool transparent(const Cell& cell, double a, double b) const {
    const double middle = std::clamp(cell.knot(0.5 * (a + b)), 0.0, 255.0);
    return table_.transparent({middle, middle, middle});
  }
  [[nodiscard]] bool all_transparent(const Cell& cell) const {
    for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) {
      if (!transparent(cell, cuts_[i], cuts_[i + 1])) return false;
    }
    return true;
  }

  void cut_at_kinks(const Cell& cell, const glm::dvec3& direction) {
    std::array<double, 4> across{};  // the polynomial g·d
    std::array<double, 7> excess{};  // the polynomial |g|² − floor²
    const double floor = scene_.shading.gradient_floor;
    excess[0] = -floor * floor;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Cubic& g = cell.gradient[axis];
      const std::array<double, 4> c{g.c0, g.c1, g.c2, g.c3};
      for (std::size_t j = 0; j < 4; ++j) {
        across[j] += direction[static_cast<int>(axis)] * c[j];
        for (std::size_t k = 0; k < 4; ++k) excess[j + k] += c[j] * c[k];
      }
    }
    append_roots(across, cuts_);
    append_roots(excess, cuts_);
    std::sort(cuts_.begin(), cuts_.end());
  }

  [[nodiscard]] RayPoint point(const Cell& cell, const glm::dvec3& direction, double s,
                               const Rgba& rgba) const {
    TableLookup lookup;
    std::copy_n(rgba.begin(), 3, lookup.colour.begin());
    if (scene_.shading.enabled) {
      const glm::dvec3 g{cell.gradient[0](s), cell.gradient[1](s), cell.gradient[2](s)};
      const double floor = scene_.shading.gradient_floor;
      shade(lookup, {std::abs(glm::dot(g, direction)) / std::max(glm::length(g), floor), 0.0},
            scene_.shading, 0.0);
    }
    return {std::min(-std::log1p(-rgba[3]), most_extinction), lookup.colour};
  }

  // Integrates the piece from a to b. `whole` is the light of the piece according to a single
  // application of the rule.
  template <typename Light>
  void add(const Light& light, double length, double a, double b, const PieceLight& whole,
           int level) {
    const double middle = 0.5 * (a + b);
    const PieceLight front = light(a, middle);
    const PieceLight back = light(middle, b);
    const PieceLight combined = front.before(back);
    const double change = std::exp(-sum_.depth) * difference(combined, whole);
    const double allowed = std::max(
        0.9 * share_per_voxel_ * length * (b - a) + 0x1.0p-20 * tolerance_, least_tolerance);
    if (change <= allowed || level == most_halvings) {
      sum_ = sum_.before(combined);
      pixel_.bound += change;
      return;
    }
    add(light, length, a, middle, front, level + 1);
    if (!dark()) add(light, length, middle, b, back, level + 1);
  }

  const scene::VolumeScene& scene_;
  double tolerance_;
  const Field<Stored>& field_;
  const Table& table_;
  RayMaker rays_;
  double smallest_spacing_;
  glm::dvec3 gradient_scale_;
  double share_per_voxel_ = 0;  // share of the tolerance per voxel length
  std::vector<double> planes_;
  std::vector<double> cuts_;  // cuts within a cell, as positions from 0 to 1
  PieceLight sum_;            // light of the ray so far
  Pixel pixel_;
};

}  // namespace

Truth render_volume_converged(const scene::VolumeScene& scene, double tolerance, int threads,
                              const OnRows& on_rows) {
  check(scene);
  return with_stored_type(scene.grid->format, [&]<typename Stored>(Stored) {
    const Field<Stored> field(*scene.grid, {});
    const Table table(scene.transfer_function, 0.0);
    return draw(
        scene, threads, [&] { return ConvergedRaycaster<Stored>(scene, tolerance, field, table); },
        on_rows);
  });
}

}  // namespace triptych::reference
