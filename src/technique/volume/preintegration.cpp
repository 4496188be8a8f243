#include "technique/volume/preintegration.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "scene/exact_math.hpp"
#include "technique/portable/prelude.hpp"

namespace triptych::technique {
namespace {

constexpr std::size_t entries = 256;
constexpr double most_extinction = 8192;  // extinction per voxel length for an entry of opacity 1

// The optical depth of a path and the moments of its colours. A path is a part of a ray along which
// the value changes linearly from one entry of the transfer function to another. It consists of
// cells, which are the intervals between adjacent entries. x is the optical depth from the
// beginning of the path, in natural units (a depth x transmits e^−x of the light), computed as if
// each cell were one voxel long. The members are ∫dx and, for each colour channel c, ∫c dx, ∫c·x dx
// and ∫c·x² dx.
struct Moments {
  double depth = 0;
  std::array<double, 3> c0{};
  std::array<double, 3> c1{};
  std::array<double, 3> c2{};

  // Extends this path by the path that follows it, whose depth and moments are `next`.
  void append(const Moments& next) {
    for (std::size_t i = 0; i < 3; ++i) {
      c2[i] += next.c2[i] + depth * (2 * next.c1[i] + depth * next.c0[i]);
      c1[i] += next.c1[i] + depth * next.c0[i];
      c0[i] += next.c0[i];
    }
    depth += next.depth;
  }
};

using Entry = std::array<float, 4>;

double extinction(double alpha) {
  return std::min(-scene::logarithm_of_1_plus(-alpha), most_extinction);
}

// Integrates one cell, which is a part of a ray along which the value changes linearly from the
// entry a to the adjacent entry b. The cell is cut into four pieces. A piece is halved as long as
// the extinction −ln(1 − alpha) differs by more than about a tenth between its ends, so pieces
// become shorter towards an end at which alpha is 1. Each piece is integrated with the five-point
// Gauss rule. The optical depth in front of a point is the sum of the depths of the previous pieces
// and the integral of a parabola, which interpolates the extinction at both ends and in the middle
// of the piece that contains the point.
class CellIntegral {
 public:
  CellIntegral(const Entry& a, const Entry& b) : a_(a), b_(b) {}

  [[nodiscard]] Moments moments() {
    constexpr int even_pieces = 4;
    for (int piece = 0; piece < even_pieces; ++piece) {
      split(static_cast<double>(piece) / even_pieces, (piece + 1.0) / even_pieces, 0);
    }
    return sum_;
  }

 private:
  [[nodiscard]] double at(std::size_t channel, double f) const {
    const auto a = static_cast<double>(a_[channel]);
    return a + f * (static_cast<double>(b_[channel]) - a);
  }
  [[nodiscard]] double tau(double f) const { return extinction(at(3, f)); }

  void split(double begin, double end, int level) {
    constexpr int deepest = 40;
    const double front = tau(begin);
    const double back = tau(end);
    const bool steep = std::abs(back - front) > 0.1 * std::max(1.0, std::min(front, back));
    if (steep && level < deepest) {
      const double middle = 0.5 * (begin + end);
      split(begin, middle, level + 1);
      split(middle, end, level + 1);
      return;
    }
    add_piece(begin, end);
  }

  void add_piece(double begin, double end) {
    static const std::array<double, 5> nodes{0.5 - 0.4530899229693320, 0.5 - 0.2692346550528415,
                                             0.5, 0.5 + 0.2692346550528415,
                                             0.5 + 0.4530899229693320};
    static constexpr std::array<double, 5> weights{0.1184634425280945, 0.2393143352496832,
                                                   0.2844444444444444, 0.2393143352496832,
                                                   0.1184634425280945};
    const double length = end - begin;
    const double t0 = tau(begin);
    const double tm = tau(0.5 * (begin + end));
    const double t1 = tau(end);
    double depth = 0;
    Moments piece;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const double s = nodes[k];
      const double f = begin + s * length;
      const double weight = weights[k] * length * tau(f);
      const double bend = 2 * (t0 - 2 * tm + t1);
      const double x = length * s * (t0 + s * ((t1 - t0 - bend) / 2 + s * bend / 3));
      depth += weight;
      for (std::size_t i = 0; i < 3; ++i) {
        const double c = at(i, f);
        piece.c0[i] += weight * c;
        piece.c1[i] += weight * c * x;
        piece.c2[i] += weight * c * x * x;
      }
    }
    piece.depth = depth;
    sum_.append(piece);
  }

  const Entry& a_;
  const Entry& b_;
  Moments sum_;
};

// Writes the three texels that describe a path in the table (preintegration.hpp). A path is a part
// of a ray along which the value changes linearly from one entry of the transfer function to
// another. The texels are computed from the path's optical depth and from the moments of its
// colours. If the path has no optical depth, its colour is `colour`.
void write(const Moments& m, const Entry& colour, std::array<float, 4>* texels) {
  texels[0] = {static_cast<float>(m.depth * std::numbers::log2e), colour[0], colour[1], colour[2]};
  texels[1] = texels[2] = {0, 0, 0, 0};
  if (!(m.depth > 0)) return;
  for (std::size_t i = 0; i < 3; ++i) {
    const double y0 = m.c0[i] / m.depth;
    const double y1 = m.c1[i] / (m.depth * m.depth);
    const double y2 = m.c2[i] / (m.depth * m.depth * m.depth);
    texels[0][i + 1] = static_cast<float>(y0);
    texels[1][i] = static_cast<float>(3 * (2 * y1 - y0));
    texels[2][i] = static_cast<float>(5 * (6 * y2 - 6 * y1 + y0));
  }
}

}  // namespace

std::vector<std::array<float, 4>> preintegrated_pairs(const scene::TransferFunction& function) {
  const auto& table = function.entries;
  std::vector<Moments> up(entries - 1);    // [k]: the path from entry k to entry k + 1
  std::vector<Moments> down(entries - 1);  // [k]: the path from entry k + 1 to entry k
  for (std::size_t k = 0; k + 1 < entries; ++k) {
    up[k] = CellIntegral(table[k], table[k + 1]).moments();
    down[k] = CellIntegral(table[k + 1], table[k]).moments();
  }
  std::vector<std::array<float, 4>> pairs(texels_per_pair * entries * entries);
  for (std::size_t from = 0; from < entries; ++from) {
    const auto at = [&](std::size_t to) { return &pairs[texels_per_pair * (entries * from + to)]; };
    Moments path;
    write(path, table[from], at(from));
    for (std::size_t to = from + 1; to < entries; ++to) {
      path.append(up[to - 1]);
      write(path, table[from], at(to));
    }
    path = {};
    for (std::size_t to = from; to-- > 0;) {
      path.append(down[to]);
      write(path, table[from], at(to));
    }
  }
  return pairs;
}

int preintegration_form(const scene::VolumeScene& scene) {
  if (scene.quadrature != scene::Quadrature::preintegrated) return 0;
  double most = 0;
  for (const Entry& entry : scene.transfer_function.entries) {
    most = std::max(most, extinction(static_cast<double>(entry[3])));
  }
  const double deepest = most * std::numbers::log2e * scene.step_voxels;
  return deepest > static_cast<double>(TRI_DEEPEST_CHUNK) ? 2 : 1;
}

}  // namespace triptych::technique
