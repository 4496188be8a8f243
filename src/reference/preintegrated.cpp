#include "reference/preintegrated.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace triptych::reference {

namespace {

constexpr double last_entry = 255;

// −ln(1 − alpha) averaged while alpha runs straight from a to b: by F(α) = (1 − α)·ln(1 − α) + α,
// whose derivative it is, or where that cancels by its series around the middle.
double mean_extinction(double a, double b) {
  const double middle = 0.5 * (a + b);
  const double left = 1.0 - middle;
  if (!(left > 0.0)) return std::numeric_limits<double>::infinity();
  const double r = 0.5 * std::abs(b - a) / left;
  if (r < 0.2) {
    const double q = r * r;
    double sum = 0.0;
    for (int n = 10; n > 0; --n) sum = q * (sum + 1.0 / (2.0 * n * (2.0 * n + 1.0)));
    return sum - std::log1p(-middle);
  }
  const auto integral = [](double alpha) {
    return alpha < 1.0 ? (1.0 - alpha) * std::log1p(-alpha) + alpha : 1.0;
  };
  return (integral(b) - integral(a)) / (b - a);
}

double opacity_of(double depth) {
  return -std::expm1(-depth);
}

}  // namespace

Preintegration::Preintegration(const Table& table, const ErrorModel& model)
    : table_(table), model_(model) {}

Preintegration::Rgba Preintegration::at(double position) const {
  return table_.at(std::clamp(position, 0.0, last_entry));
}

Preintegration::Reach Preintegration::reach(double lo, double hi) const {
  const double first = std::clamp(std::floor(lo), 0.0, last_entry - 1);
  const double last = std::clamp(std::floor(hi), 0.0, last_entry - 1);
  Reach reach;
  for (double k = first; k <= last; k += 1.0) {
    const Rgba a = at(k);
    const Rgba b = at(k + 1);
    for (std::size_t i = 0; i < 4; ++i) {
      reach.slope[i] = std::max(reach.slope[i], std::abs(b[i] - a[i]));
    }
    reach.most_alpha = std::max({reach.most_alpha, a[3], b[3]});
  }
  return reach;
}

bool Preintegration::transparent(const Bounded& front, const Bounded& back) const {
  const Span a = Table::span_of(front);
  const Span b = Table::span_of(back);
  return table_.transparent(
      {.centre = a.centre, .lo = std::min(a.lo, b.lo), .hi = std::max(a.hi, b.hi)});
}

// Beyond the table the function is constant: there the ends are cut at as the entries are.
std::vector<Preintegration::Piece> Preintegration::cut(double from, double to,
                                                       double length) const {
  std::vector<Piece> pieces;
  const double direction = to < from ? -1.0 : 1.0;
  const double per_entry = from == to ? 0.0 : length / std::abs(to - from);
  const double lowest = std::max(std::floor(std::min(from, to)) + 1.0, 0.0);
  const double highest = std::min(std::ceil(std::max(from, to)) - 1.0, last_entry);
  double here = from;
  const auto go_to = [&](double there) {
    pieces.push_back({at(here), at(there), per_entry * std::abs(there - here)});
    here = there;
  };
  for (double n = 0.0; n <= highest - lowest; n += 1.0) {
    go_to(direction > 0.0 ? lowest + n : highest - n);
  }
  go_to(to);
  if (from == to) pieces.back().length = length;
  return pieces;
}

void Preintegration::add(const Piece& piece, int level, Light& light) {
  constexpr int deepest = 24;
  if (!(piece.length > 0.0)) return;
  const double mean = mean_extinction(piece.a[3], piece.b[3]);
  const double depth = piece.length * mean;
  const double left = 1.0 - 0.5 * (piece.a[3] + piece.b[3]);
  const bool steep = std::abs(piece.b[3] - piece.a[3]) > 0.2 * left || depth > 0.5;
  if (steep && level < deepest && light.depth < 60.0 && left > 0.0) {
    Rgba middle{};
    for (std::size_t i = 0; i < 4; ++i) middle[i] = 0.5 * (piece.a[i] + piece.b[i]);
    add({piece.a, middle, 0.5 * piece.length}, level + 1, light);
    add({middle, piece.b, 0.5 * piece.length}, level + 1, light);
    return;
  }
  // Gauss's rule with four points; its weights are scaled so that a constant colour is exact.
  static constexpr std::array<double, 4> nodes{0.0694318442029737, 0.3300094782075719,
                                               0.6699905217924281, 0.9305681557970263};
  static constexpr std::array<double, 4> weights{0.1739274225687269, 0.3260725774312731,
                                                 0.3260725774312731, 0.1739274225687269};
  const double opacity = opacity_of(depth);
  const double front = std::exp(-light.depth);
  if (opacity > 0.0) {
    std::array<double, 3> colour{};
    double whole = 0.0;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const double s = nodes[k];
      const double alpha = piece.a[3] + s * (piece.b[3] - piece.a[3]);
      const double passed = s * piece.length * mean_extinction(piece.a[3], alpha);
      double weight = weights[k] * -std::log1p(-std::min(alpha, 1.0)) * std::exp(-passed);
      if (!std::isfinite(weight)) weight = weights[k];
      whole += weight;
      for (std::size_t i = 0; i < 3; ++i) {
        colour[i] += weight * (piece.a[i] + s * (piece.b[i] - piece.a[i]));
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      light.colour[i] += front * opacity * (whole > 0.0 ? colour[i] / whole : piece.a[i]);
    }
  }
  light.depth += depth;
}

Segment Preintegration::operator()(const Bounded& front, const Bounded& back,
                                   const StepLength& length) const {
  const double from = Table::knot_of(front.value);
  const double to = Table::knot_of(back.value);
  const double e = 256.0 * std::max(front.error, back.error);
  const Reach around = reach(std::min(from, to) - e, std::max(from, to) + e);
  const double alpha_error = e * around.slope[3] + model_.table_error;

  // Per voxel length, averaged along the path: the optical depth, its least and its most.
  const std::vector<Piece> pieces = cut(from, to, 1.0);
  Light light;
  double least = 0.0;
  double most = 0.0;
  Rgba lowest = pieces.front().a;
  Rgba highest = lowest;
  for (const Piece& piece : pieces) {
    add({piece.a, piece.b, piece.length * length.nominal}, 0, light);
    const auto changed = [&](double by) {
      return piece.length > 0.0
                 ? piece.length * mean_extinction(std::clamp(piece.a[3] + by, 0.0, 1.0),
                                                  std::clamp(piece.b[3] + by, 0.0, 1.0))
                 : 0.0;
    };
    least += changed(-alpha_error);
    most += changed(alpha_error);
    for (std::size_t i = 0; i < 3; ++i) {
      lowest[i] = std::min(lowest[i], piece.b[i]);
      highest[i] = std::max(highest[i], piece.b[i]);
    }
  }
  const double left = std::max(1.0 - around.most_alpha, 0.0);
  const double r = left > 0.0 ? std::min(0.5 * around.slope[3] / left, 1.0) : 1.0;
  const double tail = std::min(std::pow(r, 14) / (210.0 * (1.0 - r * r)), 0.038);

  // Extinction may be infinite, a length zero.
  const auto depth_of = [](double voxels, double tau) { return voxels > 0.0 ? voxels * tau : 0.0; };
  const double depth_lo = depth_of(length.shortest, std::max(least - tail, 0.0));
  const double depth_hi = depth_of(length.longest, most + tail);
  Segment segment;
  StepOpacity& opacity = segment.opacity;
  opacity.nominal = opacity_of(light.depth);
  opacity.lo = opacity_of(depth_lo) * std::max(1.0 - model_.opacity_error, 0.0);
  opacity.hi = std::min(opacity_of(depth_hi) * (1.0 + model_.opacity_error), 1.0);
  const double error = std::max(opacity.hi - opacity.nominal, opacity.nominal - opacity.lo);
  const double opacity_hi = std::min(opacity.nominal + error, 1.0);
  // Infinite where a device may find opacity 1: then only the range of the colour bounds the light.
  const double depth_change =
      std::isfinite(depth_hi) ? std::max(depth_hi - light.depth, light.depth - depth_lo) : depth_hi;
  const double bend = left > 0.0 ? around.slope[3] * around.slope[3] / (8.0 * left * left)
                                 : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const double value_error = e * around.slope[i] + model_.table_error;
    const double range = highest[i] - lowest[i] + 2.0 * value_error;
    const double weights = std::min(2.0 * range * depth_change, range * opacity_hi);
    const double cut_off = range * std::min(std::pow(depth_hi, 4) / 635.0, opacity_hi);
    const double cells = around.slope[i] * std::min(2.0 * length.longest * bend, opacity_hi);
    Looked& looked = segment.looked;
    looked.colour[i] =
        opacity.nominal > 0.0 ? light.colour[i] / opacity.nominal : pieces.front().a[i];
    looked.colour_error[i] = value_error + 8.0 * model_.compositing_error;
    if (opacity_hi > 0.0) {
      looked.colour_error[i] += (weights + cut_off + cells) / opacity_hi;
    }
  }
  return segment;
}

}  // namespace triptych::reference
