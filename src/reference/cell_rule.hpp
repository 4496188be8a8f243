#pragma once
// Applies Quadrature::cells along one ray and bounds the errors of a device.
//
// A cell is the cube between eight neighbouring voxel centres. A kink is an entry of the transfer
// function at which its slope changes (scene/kinks.hpp). The ray is cut where it passes from one
// cell to the next. Each segment between these cuts is divided into equal parts
// (VolumeScene::parts_of_cell), which are cut again where the value passes a kink. A piece is what
// lies between two neighbouring cuts.
//
// A piece is integrated by the two-point Gauss rule. Let τ₁ and τ₂ be the extinctions at the two
// points, and c₁ and c₂ the colours. The optical depth of the piece is its length times the mean of
// τ₁ and τ₂. The colour is assumed to be linear in y, the share of the piece's optical depth that
// has been passed, so the colour of the piece is c₁ + f·(c₂ − c₁). By collocation, the points are
// at y = ½ ∓ (1 ± δ)/(2√3), with δ = (τ₂ − τ₁)/(τ₁ + τ₂). The mean of y under the weight e^(−Dy),
// where D is the optical depth, is ½ − ½·L(D/2) with L(z) = coth z − 1/z. Therefore
//
//   f = ½·(1 + δ − √3·L(D/2)), clamped to [0, 1].
//
// A device cuts the ray and looks up values at slightly different positions, because its positions
// and values have errors. The exact integral does not depend on the cuts. The image of a device can
// therefore differ for two reasons:
//
//   - The values at the points have errors, like those of a sample. They change the integrand along
//     the ray.
//   - The rule itself has an error, both on the device and here. It is estimated by halving a
//     piece, which leaves a sixteenth of the error. The change is therefore 15/16 of the error. If
//     the values have an extremum that differs from a kink by no more than the error of the values,
//     a device may leave a piece uncut that is cut in two here, which multiplies the error of the
//     rule by 16.
//
// If a device makes the same cuts, its rule has nearly the same error as the rule here. Suppose
// that an end of a piece of length h moves by ε. Then the rule and the integral of a function g
// change by at most ε·(range of g + h·|g′|/2), with the derivative g′ at the points. For a cubic,
// h·|g′| ≤ 3√(3/2)·range at the points (Bernstein), so the change is less than 3·ε·range. The six
// points that are looked up here (two on the piece and two on each of its halves) cover more than
// three quarters of this range. A cut next to an extremum of the values moves by up to twice the
// error of the values divided by their slope, because the kink differs from the extremum by more
// than this error. The total factor is therefore 3·4/3·2 = 8.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "reference/cubic.hpp"
#include "reference/drawing.hpp"
#include "reference/extinction.hpp"
#include "reference/field.hpp"
#include "reference/opacity.hpp"
#include "reference/ray.hpp"
#include "reference/shading.hpp"
#include "reference/table.hpp"
#include "reference/volume.hpp"
#include "scene/kinks.hpp"

namespace triptych::reference {

// The number of points that a device looks up in one piece. It is normally `most`, but may differ
// by up to `open`.
struct OpenPoints {
  double begin = 0;  // distance of the piece from the ray's entry
  double end = 0;
  double most = 2;
  double open = 0;
  double maybe_visible = 0;  // number of points that may or may not have opacity
};

template <typename Stored>
class CellRule {
 public:
  CellRule(const scene::VolumeScene& scene, const ErrorModel& model, const Field<Stored>& field,
           const Table& table)
      : scene_(scene),
        model_(model),
        field_(field),
        table_(table),
        kinks_(scene::kinks(scene.transfer_function)),
        parts_(scene.parts_of_cell()),
        smallest_spacing_(scene.smallest_spacing()),
        gradient_scale_(gradient_scale(*scene.grid)) {}

  // Calls take(lookup, opacity) for every piece that may be visible on a device, from front to
  // back, until `take` returns false. The alphas of `lookup` are meaningless.
  template <typename Take>
  void walk(const Ray& ray, Take take) {
    const auto take_visible = [&](const Piece& piece) {
      return !piece.visible || take(piece.lookup, piece.opacity);
    };
    const double slack = ray.slack();
    if (slack > 0.0 && !take_visible(piece_beyond(ray, -slack, 0.0))) return;
    const bool passed = for_each_piece(ray, [&](const Part& part, double from, double to) {
      return take_visible(judged_piece(ray, part, from, to));
    });
    if (slack > 0.0 && passed) take_visible(piece_beyond(ray, ray.length, ray.length + slack));
  }

  // Calls take(points, opacity) for every piece, from front to back, until `take` returns false.
  // `points` states how many points a device looks up.
  template <typename Take>
  void walk_open(const Ray& ray, Take take) {
    for_each_piece(ray, [&](const Part& part, double from, double to) {
      OpenPoints points{.begin = from, .end = to};
      const bool uncertain = to - from <= time_error(ray, part, from) + time_error(ray, part, to) ||
                             doubtful_length(ray, from, to) >= to - from;
      points.open = !part.certain || uncertain ? 2 : 0;
      if (from <= part.begin && part.touches_a_kink) points.open += 4;
      const double middle = 0.5 * (from + to);
      const double apart = (to - from) * (0.5 / std::sqrt(3.0));
      for (const double t : {middle - apart, middle + apart}) {
        const TableLookup lookup = look_up_at(ray, t);
        if (lookup.alpha_hi > 0.0 && !(lookup.alpha_lo > 0.0)) points.maybe_visible += 1;
      }
      return take(points, gauss(ray, from, to, length_of(ray, from, to)).opacity);
    });
  }

 private:
  using Range = std::pair<double, double>;

  // Light and opacity of a piece, and the errors of both.
  struct Piece {
    TableLookup lookup;
    StepOpacity opacity;
    bool visible = false;
    Range extinction;             // range of the extinction over the points
    std::array<Range, 3> colour;  // range of the colour over the points, by channel
  };

  [[nodiscard]] bool is_kink(double knot) const { return kinks_[static_cast<std::size_t>(knot)]; }

  // Returns whether an extremum of the values along the ray may pass a kink on a device but not in
  // this reference rule, or vice versa.
  [[nodiscard]] bool touches_a_kink(const Cubic& cubic, double error) const {
    const std::array<double, 4> ends = cubic.monotone_ends();
    return std::any_of(ends.begin() + 1, ends.end() - 1, [&](double s) {
      if (s <= 0.0 || s >= 1.0) return false;
      const double lowest = std::clamp(std::ceil(cubic(s) - error), 0.0, 256.0);
      const double highest = std::clamp(std::floor(cubic(s) + error), -1.0, 255.0);
      for (double k = lowest; k <= highest; k += 1.0) {
        if (is_kink(k)) return true;
      }
      return false;
    });
  }

  // The segment of the ray in a cell, or one of the parts into which it is cut.
  struct Part {
    double begin = 0;
    double end = 0;
    Cubic cubic;           // values along the part, as positions in the table
    double error = 0;      // error of these positions
    bool certain = false;  // whether the part is visible on every device
    bool touches_a_kink = false;
    std::array<double, 2> cell_interval{};  // distances at which the ray enters and leaves the cell
  };

  // Returns the part if it may be visible on a device, and nullopt otherwise.
  [[nodiscard]] std::optional<Part> visible_part(const Ray& ray, double begin, double end) const {
    Part part{.begin = begin, .end = end};
    part.cubic = Cubic::along(ray, begin, end,
                              [&](const glm::dvec3& p) { return Table::knot_of(field_.at(p)); });
    const auto [lowest, highest] = bounds(part.cubic);
    const glm::dvec3 middle = ray.entry + 0.5 * (begin + end) * ray.voxels_per_unit;
    part.error = 256.0 * field_.at(middle, ray.position_error).error;
    const auto place = [](double u) { return std::clamp(u, 0.0, 255.0); };
    const double error = part.error;
    if (table_.transparent({place(lowest), place(lowest - error), place(highest + error)})) {
      return std::nullopt;
    }
    const double inner = std::max(lowest + error, highest - error);
    part.certain =
        !table_.transparent({place(lowest), place(std::min(lowest + error, inner)), place(inner)});
    part.touches_a_kink = touches_a_kink(part.cubic, error);
    return part;
  }

  // Calls take(part, from, to) for every piece, from front to back, until `take` returns false.
  // Returns whether `take` always returned true.
  template <typename Take>
  bool for_each_piece(const Ray& ray, Take take) {
    cut_at_planes(ray, scene_.grid->size, planes_);
    for (std::size_t i = 0; i + 1 < planes_.size(); ++i) {
      for (int part = 0; part < parts_; ++part) {
        const double width = planes_[i + 1] - planes_[i];
        const double begin = planes_[i] + width * part / parts_;
        const double end =
            part + 1 < parts_ ? planes_[i] + width * (part + 1) / parts_ : planes_[i + 1];
        std::optional<Part> visible = visible_part(ray, begin, end);
        if (!visible) continue;
        visible->cell_interval = {planes_[i], planes_[i + 1]};
        if (!cut_at_kinks(*visible, take)) return false;
      }
    }
    return true;
  }

  template <typename Take>
  bool cut_at_kinks(const Part& part, Take& take) {
    const double width = part.end - part.begin;
    cuts_.assign({0.0});
    part.cubic.append_knots(cuts_, [&](double knot) { return is_kink(knot); });
    cuts_.push_back(1.0);
    for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) {
      const double from = part.begin + width * cuts_[i];
      const double to = i + 2 < cuts_.size() ? part.begin + width * cuts_[i + 1] : part.end;
      if (!take(part, from, to)) return false;
    }
    return true;
  }

  // Returns the largest distance between a cut at t and the same cut on a device, regardless of
  // where the device's ray begins. For an end of the part, it is the position error at the nearest
  // plane of voxel centres. For any other cut, it is the error of the position at which the values
  // pass a kink.
  [[nodiscard]] double time_error(const Ray& ray, const Part& part, double t) const {
    if (t > part.begin && t < part.end) {
      const double s = (t - part.begin) / (part.end - part.begin);
      const double slope = std::abs(part.cubic.slope(s));
      return (part.end - part.begin) * std::min(1.0, part.error / std::max(slope, 1e-300));
    }
    double nearest = 1.0;
    double error = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double speed = std::abs(ray.voxels_per_unit[axis]);
      if (speed == 0.0) continue;
      const double place = ray.entry[axis] + t * ray.voxels_per_unit[axis] - 0.5;
      const double away = std::abs(place - std::round(place));
      if (away < nearest) error = model_.position_error_voxels / speed;
      nearest = std::min(nearest, away);
    }
    return error;
  }

  // Returns bounds on the values along the part, which are the extremes of the cubic's Bernstein
  // coefficients.
  [[nodiscard]] static Range bounds(const Cubic& cubic) {
    const double b0 = cubic.c0;
    const double b1 = b0 + cubic.c1 / 3.0;
    const double b2 = b1 + (cubic.c1 + cubic.c2) / 3.0;
    const double b3 = b0 + cubic.c1 + cubic.c2 + cubic.c3;
    return std::minmax({b0, b1, b2, b3});
  }

  // Returns the length of that part of a piece that may be outside the volume on a device.
  [[nodiscard]] static double doubtful_length(const Ray& ray, double from, double to) {
    const double slack = ray.slack();
    const double begin = std::max(std::min(to, slack) - from, 0.0);
    const double end = std::max(to - std::max(from, ray.length - slack), 0.0);
    return std::min(begin + end, to - from);
  }

  [[nodiscard]] StepLength length_of(const Ray& ray, double from, double to) const {
    const double nominal = (to - from) / smallest_spacing_;
    return {nominal, nominal - doubtful_length(ray, from, to) / smallest_spacing_, nominal};
  }

  // Returns the ray with a position error that also covers a displacement of the points along the
  // ray by up to `distance`.
  [[nodiscard]] static Ray widened(Ray ray, double distance) {
    ray.position_error = ray.position_error_within(distance);
    return ray;
  }

  // Returns the piece between two distances that are outside the volume on this ray, but that may
  // be inside the volume on a device's ray.
  [[nodiscard]] Piece piece_beyond(const Ray& ray, double from, double to) const {
    const Ray wide = widened(ray, 0.5 * (to - from));
    return gauss(wide, from, to, {0.0, 0.0, (to - from) / smallest_spacing_});
  }

  // Returns the largest distance between the end t of a piece and the same end on a device. If a
  // cell is cut into equal parts, the cuts move with the ends of the cell.
  [[nodiscard]] double end_error(const Ray& ray, const Part& part, double t) const {
    if (parts_ == 1 || (t > part.begin && t < part.end)) return time_error(ray, part, t);
    return std::max(time_error(ray, part, part.cell_interval[0]),
                    time_error(ray, part, part.cell_interval[1]));
  }

  // Returns the factor by which the range of the integrand, times the length of the piece, bounds
  // the change of the integral if a device moves the ends of the piece (the factor 8 is derived at
  // the top of this file). A result of 1 means that a device may make other cuts, so this bound
  // does not apply.
  [[nodiscard]] double shift_of(const Ray& ray, const Part& part, double from, double to) const {
    if (part.touches_a_kink || doubtful_length(ray, from, to) > 0.0) return 1.0;
    const double moved = end_error(ray, part, from) + end_error(ray, part, to);
    return std::min(8.0 * moved / (to - from), 1.0);
  }

  [[nodiscard]] Piece judged_piece(const Ray& ray, const Part& part, double from, double to) const {
    const double doubtful = doubtful_length(ray, from, to);
    Piece piece =
        gauss(doubtful > 0.0 ? widened(ray, doubtful) : ray, from, to, length_of(ray, from, to));
    if (!piece.visible) return piece;
    const double middle = 0.5 * (from + to);
    const double half = 0.5 * (to - from) / smallest_spacing_;
    const Piece front = gauss(ray, from, middle, {half, half, half});
    const Piece back = gauss(ray, middle, to, {half, half, half});
    const double left = 1.0 - front.opacity.nominal;
    const double doubt = part.touches_a_kink ? 18.0 : 2.2;
    const double shift = shift_of(ray, part, from, to);
    const auto change_of = [&](double halved, double whole, double if_shifted) {
      const double change = doubt * std::abs(halved - whole);
      return shift < 1.0 ? std::min(change, shift * if_shifted) : change;
    };
    const auto [thinnest, densest] = joined(piece.extinction, front.extinction, back.extinction);
    StepOpacity& opacity = piece.opacity;
    const double change = change_of(front.opacity.nominal + left * back.opacity.nominal,
                                    opacity.nominal, 2.0 * half * (densest - thinnest));
    opacity.lo = std::max(opacity.lo - change, 0.0);
    opacity.hi = std::min(opacity.hi + change, 1.0);
    if (!(opacity.hi > 0.0)) return piece;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [darkest, brightest] = joined(piece.colour[i], front.colour[i], back.colour[i]);
      const double halved = front.opacity.nominal * front.lookup.colour[i] +
                            left * back.opacity.nominal * back.lookup.colour[i];
      piece.lookup.colour_error[i] += change_of(halved, opacity.nominal * piece.lookup.colour[i],
                                                2.0 * half * densest * (brightest - darkest)) /
                                      opacity.hi;
    }
    return piece;
  }

  [[nodiscard]] static Range joined(const Range& a, const Range& b, const Range& c) {
    return {std::min({a.first, b.first, c.first}), std::max({a.second, b.second, c.second})};
  }

  // The extinction at a point, with the smallest and largest extinction that a device may find.
  struct Extinction {
    double nominal;
    double lo;
    double hi;
  };
  [[nodiscard]] static Extinction extinction(const TableLookup& lookup) {
    const auto of = [](double alpha) {
      constexpr double opaque = 8192 * 0.693147180559945309;
      return alpha < 1.0 ? extinction_of(alpha) : opaque;
    };
    return {of(lookup.alpha), of(lookup.alpha_lo), of(lookup.alpha_hi)};
  }

  [[nodiscard]] TableLookup look_up_at(const Ray& ray, double t) const {
    const glm::dvec3 p = ray.entry + t * ray.voxels_per_unit;
    return table_.look_up(Table::span_of(field_.at(p, ray.position_error)));
  }

  // Shades the colour at t. This is also done at a point without opacity, because the colour of a
  // piece depends on the colours at both of its points.
  void shade_at(const Ray& ray, double t, TableLookup& lookup) const {
    const glm::dvec3 p = ray.entry + t * ray.voxels_per_unit;
    const double rounding = model_.compositing_error;
    shade(
        lookup,
        headlight_cosine(field_, ray, p, gradient_scale_, scene_.shading.gradient_floor, rounding),
        scene_.shading, rounding);
  }

  // Returns coth z − 1/z. For z < 0.05, where the difference would suffer from cancellation, it
  // uses the series, with an error below 1e-15.
  [[nodiscard]] static double langevin(double z) {
    if (z < 0.05) return z * (1.0 / 3.0 - z * z * (1.0 / 45.0 - z * z * 2.0 / 945.0));
    return 1.0 / std::tanh(z) - 1.0 / z;
  }

  [[nodiscard]] static double share(double a, double b, double attenuation) {
    const double sum = a + b;
    const double tilt = sum > 0.0 ? (b - a) / sum : 0.0;
    return std::clamp(0.5 * (1.0 + tilt - std::sqrt(3.0) * attenuation), 0.0, 1.0);
  }

  [[nodiscard]] Piece gauss(const Ray& ray, double from, double to,
                            const StepLength& length) const {
    const double middle = 0.5 * (from + to);
    const double apart = (to - from) * (0.5 / std::sqrt(3.0));
    TableLookup a = look_up_at(ray, middle - apart);
    TableLookup b = look_up_at(ray, middle + apart);
    Piece piece;
    piece.visible = a.alpha_hi > 0.0 || b.alpha_hi > 0.0;
    if (!piece.visible) return piece;
    if (scene_.shading.enabled) {
      shade_at(ray, middle - apart, a);
      shade_at(ray, middle + apart, b);
    }
    const Extinction ta = extinction(a);
    const Extinction tb = extinction(b);
    const double depth = 0.5 * length.nominal * (ta.nominal + tb.nominal);
    const double depth_lo = 0.5 * length.shortest * (ta.lo + tb.lo);
    const double depth_hi = 0.5 * length.longest * (ta.hi + tb.hi);
    piece.extinction = std::minmax(ta.nominal, tb.nominal);
    piece.opacity.nominal = opacity_of(depth);
    piece.opacity.lo = opacity_of(depth_lo) * std::max(1.0 - model_.opacity_error, 0.0);
    piece.opacity.hi = std::min(opacity_of(depth_hi) * (1.0 + model_.opacity_error), 1.0);
    const double f = share(ta.nominal, tb.nominal, langevin(0.5 * depth));
    const double f_lo = share(ta.hi, tb.lo, langevin(0.5 * depth_hi));
    const double f_hi = share(ta.lo, tb.hi, langevin(0.5 * depth_lo));
    const double rounding = 8.0 * model_.compositing_error;
    for (std::size_t i = 0; i < 3; ++i) {
      piece.colour[i] = std::minmax(a.colour[i], b.colour[i]);
      const double range = piece.colour[i].second - piece.colour[i].first;
      piece.lookup.colour[i] = a.colour[i] + f * (b.colour[i] - a.colour[i]);
      piece.lookup.colour_error[i] = std::max(a.colour_error[i], b.colour_error[i]) +
                                     range * std::max(f_hi - f, f - f_lo) + rounding;
    }
    return piece;
  }

  const scene::VolumeScene& scene_;
  const ErrorModel& model_;
  const Field<Stored>& field_;
  const Table& table_;
  std::array<bool, 256> kinks_;
  int parts_;
  double smallest_spacing_;
  glm::dvec3 gradient_scale_;
  std::vector<double> planes_;
  std::vector<double> cuts_;
};

}  // namespace triptych::reference
