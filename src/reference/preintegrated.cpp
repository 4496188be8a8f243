#include "reference/preintegrated.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/extinction.hpp"

namespace triptych::reference {

namespace {

constexpr double last_entry = 255;

}  // namespace

Preintegration::Preintegration(const Table& table, const ErrorModel& model)
    : table_(table), model_(model) {}

Preintegration::Rgba Preintegration::at(double position) const {
  return table_.at(std::clamp(position, 0.0, last_entry));
}

bool Preintegration::transparent(const Bounded& front, const Bounded& back) const {
  const Span a = Table::span_of(front);
  const Span b = Table::span_of(back);
  return table_.transparent(
      {.centre = a.centre, .lo = std::min(a.lo, b.lo), .hi = std::max(a.hi, b.hi)});
}

// Cuts a step, along which the value changes linearly, at the entries of the table. Beyond the
// table, the transfer function is constant, so the step is cut at the ends of the table in the same
// way.
std::vector<PathPiece> Preintegration::cut(double from, double to, double length) const {
  std::vector<PathPiece> pieces;
  const double direction = to < from ? -1.0 : 1.0;
  const double per_entry = from == to ? 0.0 : length / std::abs(to - from);
  const double lowest = std::max(std::floor(std::min(from, to)) + 1.0, 0.0);
  const double highest = std::min(std::ceil(std::max(from, to)) - 1.0, last_entry);
  double position = from;
  const auto advance_to = [&](double next) {
    pieces.push_back(
        {at(position), at(next), per_entry * std::abs(next - position), 0.5 * (position + next)});
    position = next;
  };
  for (double n = 0.0; n <= highest - lowest; n += 1.0) {
    advance_to(direction > 0.0 ? lowest + n : highest - n);
  }
  advance_to(to);
  if (from == to) pieces.back().length = length;
  return pieces;
}

void Preintegration::add(const PathPiece& piece, int level, Light& light) {
  constexpr int deepest = 24;
  if (!(piece.length > 0.0)) return;
  const double mean = mean_extinction(piece.a[3], piece.b[3]);
  const double depth = piece.length * mean;
  const double left = 1.0 - 0.5 * (piece.a[3] + piece.b[3]);
  const bool steep = std::abs(piece.b[3] - piece.a[3]) > 0.2 * left || depth > 0.5;
  if (steep && level < deepest && light.depth < 60.0 && left > 0.0) {
    Rgba middle{};
    for (std::size_t i = 0; i < 4; ++i) middle[i] = 0.5 * (piece.a[i] + piece.b[i]);
    add({piece.a, middle, 0.5 * piece.length, piece.middle}, level + 1, light);
    add({middle, piece.b, 0.5 * piece.length, piece.middle}, level + 1, light);
    return;
  }
  // The four-point Gauss rule. Its weights are scaled so that a constant colour is exact.
  static constexpr std::array<double, 4> nodes{0.0694318442029737, 0.3300094782075719,
                                               0.6699905217924281, 0.9305681557970263};
  static constexpr std::array<double, 4> weights{0.1739274225687269, 0.3260725774312731,
                                                 0.3260725774312731, 0.1739274225687269};
  const double opacity = opacity_of(depth);
  const double front = std::exp(-light.depth);
  if (!std::isfinite(depth)) {  // opaque everywhere: nothing behind its front is visible
    for (std::size_t i = 0; i < 3; ++i) light.colour[i] += front * piece.a[i];
  } else if (opacity > 0.0) {
    std::array<double, 3> colour{};
    double whole = 0.0;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const double s = nodes[k];
      const double alpha = piece.a[3] + s * (piece.b[3] - piece.a[3]);
      const double passed = s * piece.length * mean_extinction(piece.a[3], alpha);
      const double weight = weights[k] * -std::log1p(-alpha) * std::exp(-passed);
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
  const std::vector<PathPiece> pieces = cut(from, to, 1.0);
  PreintegrationBound bound(table_, model_,
                            {.from = from,
                             .to = to,
                             .error = 256.0 * std::max(front.error, back.error),
                             .length = length,
                             .pieces = pieces.size()});
  Light light;
  for (const PathPiece& piece : pieces) {
    const double before = light.depth;
    add({piece.a, piece.b, piece.length * length.nominal, piece.middle}, 0, light);
    // If the pieces in front are opaque, `before` is infinite, and the depth of this piece cannot
    // be computed. Nothing of the piece is visible then, so 0 is used.
    bound.add(piece, std::isfinite(before) ? light.depth - before : 0.0);
  }
  Segment segment;
  segment.opacity = bound.opacity(opacity_of(light.depth));
  for (std::size_t i = 0; i < 3; ++i) {
    segment.lookup.colour[i] = segment.opacity.nominal > 0.0
                                   ? light.colour[i] / segment.opacity.nominal
                                   : pieces.front().a[i];
    segment.lookup.colour_error[i] = bound.colour_error(i, segment.opacity);
  }
  return segment;
}

}  // namespace triptych::reference
