// Computes a step of the quadrature `preintegrated` with floats on the host, as preintegrated.glsl
// does on a device, and compares it with the reference and its error bound.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "reference/preintegrated.hpp"
#include "technique/portable/prelude.hpp"
#include "technique/volume/preintegration.hpp"

namespace triptych::technique {
namespace {

using Texel = std::array<float, 4>;
using Colour = std::array<float, 3>;

// The shader splits long steps into pieces of limited optical depth. This limit is so large that no
// step is split: all whole cells between table entries are processed at once, as in an earlier
// version of the shader.
constexpr float any_depth = 1e30F;

class Step {
 public:
  Step(const scene::TransferFunction& function, const std::vector<Texel>& pairs, float deepest)
      : function_(function), pairs_(pairs), deepest_(deepest) {}

  // Returns premultiplied colour and opacity of a step between two positions in the table.
  [[nodiscard]] Texel operator()(float from, float to, float length) {
    gathered_ = {};
    const int first_cell = static_cast<int>(std::floor(from));
    const int last_cell = static_cast<int>(std::floor(to));
    if (first_cell == last_cell) {
      add_part_of_cell(first_cell, from, to, length);
      return gathered_;
    }
    const bool rising = last_cell > first_cell;
    const int last = rising ? last_cell : last_cell + 1;
    const float per_cell = length / std::abs(to - from);
    int cell = rising ? first_cell + 1 : first_cell;
    add_part_of_cell(first_cell, from, static_cast<float>(cell),
                     per_cell * std::abs(static_cast<float>(cell) - from));
    while (cell != last) {
      const int direction = rising ? 1 : -1;
      int count = std::abs(last - cell);
      const auto too_deep = [&] {
        return count > 1 && per_cell * pair(cell, cell + direction * count)[0][0] > deepest_;
      };
      if (1 - gathered_[3] > TRI_LEAST_LEFT && too_deep()) {
        const float share = deepest_ / (per_cell * pair(cell, last)[0][0]);
        count = std::max(1, static_cast<int>(share * static_cast<float>(count)));
        while (too_deep()) count /= 2;
      }
      const int next_cell = cell + direction * count;
      const Texel* texels = pair(cell, next_cell);
      add_piece(per_cell * texels[0][0], {texels[0][1], texels[0][2], texels[0][3]},
                {texels[1][0], texels[1][1], texels[1][2]},
                {texels[2][0], texels[2][1], texels[2][2]});
      cell = next_cell;
    }
    add_part_of_cell(last_cell, static_cast<float>(last), to,
                     per_cell * std::abs(to - static_cast<float>(last)));
    return gathered_;
  }

 private:
  [[nodiscard]] const Texel* pair(int from, int to) const {
    return &pairs_[texels_per_pair * static_cast<std::size_t>(256 * from + to)];
  }

  void add_piece(float depth, const Colour& a0, const Colour& a1, const Colour& a2) {
    if (!(depth > 0)) return;
    const float opacity = portable::tri_1m_exp2(-depth);
    const float z = 0.3465735903F * depth;
    const float w = portable::tri_attenuation(z, opacity);
    const float inverse = 1 / (3 + w);
    const float weight = (1 - gathered_[3]) * opacity;
    for (std::size_t i = 0; i < 3; ++i) {
      const float colour = a0[i] - z * inverse * a1[i] + w * inverse * a2[i];
      gathered_[i] += weight * std::clamp(colour, 0.0F, 1.0F);
    }
    gathered_[3] += weight;
  }

  void add_part_of_cell(int cell, float a, float b, float length) {
    const Texel& lower = function_.entries[static_cast<std::size_t>(std::max(cell, 0))];
    const Texel& upper = function_.entries[static_cast<std::size_t>(std::min(cell + 1, 255))];
    const float f = a - static_cast<float>(cell);
    const float g = b - static_cast<float>(cell);
    const float first_alpha = lower[3] + f * (upper[3] - lower[3]);
    const float last_alpha = lower[3] + g * (upper[3] - lower[3]);
    const float mean = portable::tri_mean_log2_1m(first_alpha, last_alpha);
    const float tilt = portable::tri_tilt(first_alpha, last_alpha, mean);
    Colour a0;
    Colour a1;
    Colour a2;
    for (std::size_t i = 0; i < 3; ++i) {
      const float change = (g - f) * (upper[i] - lower[i]);
      a0[i] = lower[i] + f * (upper[i] - lower[i]) + (0.5F + tilt / 6) * change;
      a1[i] = (0.5F - 0.1F * tilt * tilt) * change;
      a2[i] = tilt * (tilt * tilt / 14 - 1.0F / 6) * change;
    }
    add_piece(-length * mean, a0, a1, a2);
  }

  const scene::TransferFunction& function_;
  const std::vector<Texel>& pairs_;
  float deepest_;
  Texel gathered_{};
};

scene::TransferFunction rough_table(core::Random& random) {
  scene::TransferFunction function;
  for (auto& entry : function.entries) {
    for (float& channel : entry) channel = static_cast<float>(random.uniform());
    if (random.uniform() < 0.2) entry[3] = 0;
    if (random.uniform() < 0.05) entry[3] = 1;
  }
  return function;
}

struct Found {
  // Largest error of the light. It is meaningful only if both ends of each step are exact.
  double largest = 0;
  // Number of steps whose result exceeds the error bound.
  int beyond = 0;
};

// Tries random steps. The device computes each end with an error of up to `error` table entries.
Found find(const scene::TransferFunction& function, double length, double error, float deepest,
           int count = 1000) {
  constexpr double u = 0x1p-24;
  const reference::ErrorModel model{
      .table_error = 4 * u, .opacity_error = 32 * u, .compositing_error = 4 * u};
  const reference::Table table(function, model.table_error);
  const reference::Preintegration steps(table, model);
  const auto pairs = preintegrated_pairs(function);
  Step device(function, pairs, deepest);
  core::Random random(7);
  Found found;
  for (int n = 0; n < count; ++n) {
    const double from = random.uniform(-0.5, 255.5);
    const double reach = n % 2 == 0 ? 256 : 3;
    const double to = std::clamp(from + random.uniform(-reach, reach), -0.5, 255.5);
    const auto moved = [&](double at) {
      return static_cast<float>(
          std::clamp(at + 0.99 * random.uniform(-error, error), -0.75, 255.75));
    };
    const auto [r, g, b, a] = device(moved(from), moved(to), static_cast<float>(length));
    // Rounding positions and their differences to floats moves an end by up to 512·u table entries,
    // where u is the round-off of a float.
    const double e = error + 512 * u;
    const reference::Segment truth =
        steps({(from + 0.5) / 256, e / 256}, {(to + 0.5) / 256, e / 256}, {length, length, length});
    bool inside = a >= truth.opacity.lo - u && a <= truth.opacity.hi + u;
    const double most =
        std::min(1.0, truth.opacity.nominal + std::max(truth.opacity.hi - truth.opacity.nominal,
                                                       truth.opacity.nominal - truth.opacity.lo));
    const std::array light{r, g, b};
    for (std::size_t i = 0; i < 3; ++i) {
      const double apart = std::abs(light[i] - a * truth.lookup.colour[i]);
      inside = inside && apart <= most * truth.lookup.colour_error[i] + 2 * u;
      const double wrong = light[i] - truth.opacity.nominal * truth.lookup.colour[i];
      found.largest = std::max(found.largest, std::abs(wrong));
    }
    if (!inside) ++found.beyond;
  }
  return found;
}

TEST(PreintegratedStep, IsExactHoweverOpaqueItIs) {
  for (const char* name : {"haze", "surfaces"}) {
    const scene::TransferFunction function = scene::load_transfer_function(name);
    for (const double length : {0.25, 1.0, 2.0, 8.0, 64.0}) {
      const Found found = find(function, length, 0, TRI_DEEPEST_CHUNK);
      EXPECT_LT(found.largest, 2e-5) << name << ' ' << length;
      EXPECT_EQ(found.beyond, 0) << name << ' ' << length;
    }
  }
}

// If all whole cells between table entries are processed at once regardless of their optical depth,
// the three coefficients that the shader uses cannot represent their light. The bound must detect
// that.
TEST(PreintegratedStep, InOneChunkExceedsTheBound) {
  const scene::TransferFunction function = scene::load_transfer_function("surfaces");
  for (const auto& [length, error] : {std::pair{2.0, 5e-3}, {64.0, 0.25}}) {
    const Found found = find(function, length, 0, any_depth);
    EXPECT_GT(found.largest, error);
    EXPECT_GT(found.beyond, 100);
  }
}

TEST(PreintegratedStep, StaysWithinItsBoundIfItsEndsAreUncertain) {
  core::Random random(3);
  std::vector<scene::TransferFunction> functions{scene::load_transfer_function("haze"),
                                                 scene::load_transfer_function("surfaces")};
  for (int n = 0; n < 3; ++n) functions.push_back(rough_table(random));
  for (std::size_t n = 0; n < functions.size(); ++n) {
    for (const double length : {0.25, 2.0, 64.0}) {
      for (const double error : {0.0, 1e-4, 0.02, 0.4, 2.0}) {
        EXPECT_EQ(find(functions[n], length, error, TRI_DEEPEST_CHUNK, 300).beyond, 0)
            << n << ", step " << length << ", off by " << error;
      }
    }
  }
}

TEST(PreintegratedStep, IsSplitIntoChunksIfItMayBeDeep) {
  scene::VolumeScene scene;
  // Each voxel halves the transmittance.
  scene.transfer_function.entries.fill({1, 1, 1, 0.5F});
  EXPECT_EQ(preintegration_form(scene), 0);
  scene.quadrature = scene::Quadrature::preintegrated;
  scene.step_voxels = 0.499;
  EXPECT_EQ(preintegration_form(scene), 1);
  scene.step_voxels = 0.501;
  EXPECT_EQ(preintegration_form(scene), 2);
}

// `tau(s)` is the extinction at the relative position s in a cell. Approximates the position as a
// function of the share of the optical depth by a polynomial with three coefficients, and returns
// the largest error of this approximation divided by the square of the tilt. The tilt is |tau_b −
// tau_a|/(tau_a + tau_b), where tau_a and tau_b are the extinctions at both ends.
double approximation_error(double tau_a, double tau_b, const auto& tau) {
  constexpr int parts = 4000;
  // Positions are denser at both ends.
  const auto place = [](int i) {
    const double x = static_cast<double>(i) / parts;
    return x * x * x * (x * (6 * x - 15) + 10);
  };
  std::vector<double> share(parts + 1);
  for (int i = 0; i < parts; ++i) {
    const auto at = static_cast<std::size_t>(i);
    share[at + 1] = share[at] + (place(i + 1) - place(i)) * tau(0.5 * (place(i) + place(i + 1)));
  }
  std::array<double, 3> a{};
  std::vector<std::array<double, 3>> polynomials(parts);
  for (int i = 0; i < parts; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double y = 0.5 * (share[at] + share[at + 1]) / share.back();
    const double weight = (share[at + 1] - share[at]) / share.back();
    polynomials[at] = {1, 2 * y - 1, 6 * y * y - 6 * y + 1};
    for (std::size_t n = 0; n < 3; ++n) {
      a[n] += static_cast<double>(2 * n + 1) * weight * polynomials[at][n] * 0.5 *
              (place(i) + place(i + 1));
    }
  }
  double most = 0;
  for (int i = 0; i < parts; ++i) {
    const auto& p = polynomials[static_cast<std::size_t>(i)];
    const double middle = 0.5 * (place(i) + place(i + 1));
    most = std::max(most, std::abs(middle - a[0] - a[1] * p[1] - a[2] * p[2]));
  }
  const double tilt = std::abs(tau_b - tau_a) / (tau_a + tau_b);
  return most / (tilt * tilt);
}

TEST(PreintegratedStep, OneCellLeavesAQuarterOfItsTiltSquared) {
  const std::vector<double> alphas{0,   1e-4, 1e-3, 0.01, 0.03, 0.1,   0.2,      0.4,
                                   0.6, 0.8,  0.9,  0.95, 0.99, 0.999, 1 - 1e-6, 1};
  for (const double a : alphas) {
    for (const double b : alphas) {
      if (a == b) continue;
      const auto tau = [&](double s) { return std::min(-std::log1p(-(a + s * (b - a))), 8192.0); };
      EXPECT_LE(approximation_error(tau(0), tau(1), tau), 0.25) << a << ' ' << b;
    }
  }
  for (const double tilt : {0.05, 0.3, 0.7, 1.0, -0.05, -0.5, -1.0}) {
    const auto tau = [&](double s) { return 1 - tilt + 2 * tilt * s; };
    EXPECT_LE(approximation_error(tau(0), tau(1), tau), 0.25) << tilt;
  }
}

}  // namespace
}  // namespace triptych::technique
