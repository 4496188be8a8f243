#pragma once
// The light of a piece of a ray along which extinction and colour are smooth.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace triptych::reference {

// The light of a piece alone: its premultiplied colour, and its optical depth. Everything behind
// the piece is attenuated by e^(−depth).
struct PieceLight {
  std::array<double, 3> colour{};
  double depth = 0.0;

  [[nodiscard]] double opacity() const { return -std::expm1(-depth); }

  // Returns the light of this piece and the next piece together. The next piece is behind this one.
  [[nodiscard]] PieceLight before(const PieceLight& next) const {
    PieceLight combined = *this;
    const double left = std::exp(-depth);
    for (std::size_t i = 0; i < 3; ++i) combined.colour[i] += left * next.colour[i];
    combined.depth += next.depth;
    return combined;
  }
};

// Returns the largest difference in any channel between two results for a piece, for any colour in
// [0, 1] behind the piece.
[[nodiscard]] inline double difference(const PieceLight& a, const PieceLight& b) {
  const double opacity = a.opacity() - b.opacity();
  double largest = std::abs(opacity);
  for (std::size_t i = 0; i < 3; ++i) {
    const double colour = a.colour[i] - b.colour[i];
    largest = std::max({largest, std::abs(colour), std::abs(colour - opacity)});
  }
  return largest;
}

// The extinction per length and the colour (not premultiplied) at a point of the ray.
struct RayPoint {
  double extinction = 0.0;
  std::array<double, 3> colour{};
};

// Integrates c·τ·e^(−D), where c is the colour and τ the extinction, over a piece by the
// three-point Gauss rule, which has order 6. The optical depth D from the front of the piece to
// each point is computed by collocation (with the coefficients of Kuntzmann and Butcher), which
// preserves the order. The result is scaled so that a constant colour is exact. `length` is the
// length of the piece, and `point_at(share)` returns its point at this fraction of the length.
template <typename PointAt>
[[nodiscard]] PieceLight gauss_light(double length, const PointAt& point_at) {
  static const double r = std::sqrt(15.0);
  static const std::array<double, 3> nodes{0.5 - r / 10, 0.5, 0.5 + r / 10};
  static constexpr std::array<double, 3> weights{5.0 / 18, 4.0 / 9, 5.0 / 18};
  static const std::array<std::array<double, 3>, 3> before{
      {{5.0 / 36, 2.0 / 9 - r / 15, 5.0 / 36 - r / 30},
       {5.0 / 36 + r / 24, 2.0 / 9, 5.0 / 36 - r / 24},
       {5.0 / 36 + r / 30, 2.0 / 9 + r / 15, 5.0 / 36}}};
  std::array<RayPoint, 3> points;
  for (std::size_t k = 0; k < 3; ++k) points[k] = point_at(nodes[k]);
  PieceLight light;
  double whole = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    double depth = 0.0;
    for (std::size_t j = 0; j < 3; ++j) depth += before[k][j] * points[j].extinction;
    const double weight =
        weights[k] * points[k].extinction * std::exp(-std::max(length * depth, 0.0));
    whole += weight;
    light.depth += length * weights[k] * points[k].extinction;
    for (std::size_t i = 0; i < 3; ++i) light.colour[i] += weight * points[k].colour[i];
  }
  const double opacity = light.opacity();
  for (std::size_t i = 0; i < 3; ++i) {
    // If all weights are 0, even the first point is completely hidden. All light then comes from
    // the part of the piece in front of this point, whose colour is used.
    const double colour = whole > 0.0 ? light.colour[i] / whole : points[0].colour[i];
    light.colour[i] = opacity * colour;
  }
  return light;
}

}  // namespace triptych::reference
