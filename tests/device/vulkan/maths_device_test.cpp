// Tests that the portable maths gives the same results in GLSL and in C++.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <span>
#include <vector>

#include "backends/vulkan/devices.hpp"
#include "backends/vulkan/instance.hpp"
#include "core/random.hpp"
#include "technique/portable/prelude.hpp"
#include "technique/volume/opacity_form.hpp"
#include "tests/device/vulkan/one_dispatch.hpp"
#include "vulkan_device_test_embedded.hpp"

namespace triptych::vulkan_backend {
namespace {

namespace portable = technique::portable;
using Vector = std::array<float, 2>;     // opacity, number of steps
using Results = std::array<float, 16>;   // see maths.comp
using Doubles = std::array<double, 16>;  // see maths_fp64.comp

std::vector<Vector> vectors() {
  std::vector<Vector> all;
  for (const float alpha :
       {0.0F, 0x1p-30F, 0x1p-24F, 0x1p-12F, 0.25F, 0.5F, 0.75F, 1 - 0x1p-24F, 1.0F}) {
    for (const float steps : {0.0F, 0x1p-10F, 0.1F, 0.5F, 1.0F, 1.5F, 2.0F}) {
      all.push_back({alpha, steps});
    }
  }
  core::Random random(11);
  while (all.size() < 4096) {
    all.push_back({static_cast<float>(random.uniform()), static_cast<float>(random.uniform(0, 2))});
  }
  return all;
}

Results on_host(const Vector& vector) {
  const auto [x, y] = vector;
  const auto slab = portable::tri_slab(x * 16.0F - 4.0F, y - 1.0F, 9.0F);
  Results results{slab.x,
                  slab.y,
                  static_cast<float>(portable::tri_sample_count(y * 256.0F)),
                  portable::tri_step_share(y * 4.0F, 2),
                  portable::tri_table_position(x),
                  portable::tri_log2_1m(x),
                  portable::tri_1m_exp2(-8.0F * y),
                  portable::tri_opacity(x, y)};
  for (int form = -2; form <= 4; ++form) {
    results.at(static_cast<std::size_t>(10 + form)) = portable::tri_opacity_by_form(x, y, form);
  }
  return results;
}

Doubles doubles_on_host(const Vector& vector) {
  namespace fp64 = portable::fp64;
  const auto x = static_cast<double>(vector[0]);
  const auto y = static_cast<double>(vector[1]);
  const double whole = std::floor(0.5 - 8.0 * y);
  Doubles results{static_cast<double>(fp64::high_word(x)),
                  fp64::with_high_word(x, 0x3fe00000),
                  whole,
                  whole,
                  fp64::tri_table_position(x),
                  fp64::tri_log2_1m(x),
                  fp64::tri_1m_exp2(-8.0 * y),
                  fp64::tri_opacity(x, y)};
  for (int form = -2; form <= 4; ++form) {
    results.at(static_cast<std::size_t>(10 + form)) = fp64::tri_opacity_by_form(x, y, form);
  }
  results.back() = fp64::tri_step_share(4.0 * y, 2);
  return results;
}

std::vector<Results> on_device(const Gpu& gpu, const std::vector<Vector>& in) {
  return dispatch_once<Results>(gpu, test_shaders::embedded("maths.comp.spv"), in,
                                static_cast<std::uint32_t>(in.size() / 64));
}

// Returns the distance in units in the last place. It is 0 for identical bits, for +0 and −0, and
// for two NaNs.
std::int64_t ulps(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  const auto ordered = [](float x) {
    const auto bits = std::bit_cast<std::int32_t>(x);
    return bits < 0 ? -static_cast<std::int64_t>(bits & 0x7fffffff) : std::int64_t{bits};
  };
  return std::llabs(ordered(a) - ordered(b));
}

TEST(VulkanMaths, MatchesTheHost) {
  const std::vector<Vector> in = vectors();
  const Instance instance;
  for (const Candidate& each : candidates(instance.physical_devices())) {
    SCOPED_TRACE(each.info.id);
    const Gpu gpu = open_gpu(each.physical);
    const std::vector<Results> out = on_device(gpu, in);
    // The functions use only sums, products, quotients and square roots. A quotient may have an
    // error of 2.5 ulp, and sums and products may be contracted to fused operations. On either
    // side, the longest chain of operations is within 8 ulp of the exact value.
    constexpr std::int64_t allowed = 16;
    for (std::size_t i = 0; i < in.size(); ++i) {
      const Results host = on_host(in[i]);
      for (std::size_t k = 0; k < host.size(); ++k) {
        ASSERT_LE(ulps(host.at(k), out[i].at(k)), allowed)
            << "result " << k << " of " << in[i][0] << ", " << in[i][1] << ": " << host.at(k)
            << " and " << out[i].at(k);
      }
    }
  }
}

// On either side, the longest chain of operations is within 12 u of the exact value, where u =
// 2⁻⁵³.
TEST(VulkanMaths, MatchesTheHostInDoublePrecision) {
  const std::vector<Vector> in = vectors();
  const Instance instance;
  for (const Candidate& each : candidates(instance.physical_devices())) {
    SCOPED_TRACE(each.info.id);
    const Gpu gpu = open_gpu(each.physical);
    if (gpu.features.shaderFloat64 == VK_FALSE) continue;
    const std::vector<Doubles> out =
        dispatch_once<Doubles>(gpu, test_shaders::embedded("maths_fp64.comp.spv"), in,
                               static_cast<std::uint32_t>(in.size() / 64));
    for (std::size_t i = 0; i < in.size(); ++i) {
      const Doubles host = doubles_on_host(in[i]);
      for (std::size_t k = 0; k < host.size(); ++k) {
        ASSERT_LE(std::abs(host.at(k) - out[i].at(k)), 24 * 0x1p-53 * std::abs(host.at(k)))
            << "result " << k << " of " << in[i][0] << ", " << in[i][1] << ": " << host.at(k)
            << " and " << out[i].at(k);
      }
    }
  }
}

TEST(VulkanMaths, ClosedFormsMatchTheGeneralForm) {
  for (const double step : {0.125, 0.25, 0.5, 1.0, 2.0, 4.0}) {
    const int form = technique::opacity_form(step);
    ASSERT_NE(form, 0);
    for (const Vector& each : vectors()) {
      const double alpha = static_cast<double>(each[0]);
      const double exact = alpha < 1 ? -std::expm1(step * std::log1p(-alpha)) : 1.0;
      const auto closed = static_cast<double>(
          portable::tri_opacity_by_form(each[0], static_cast<float>(step), form));
      EXPECT_NEAR(closed, exact, 8 * 0x1p-24 * exact) << alpha << " step " << step;
    }
  }
  for (const double step : {0.7, 3.0, 0.0625, 8.0, 1000.0}) {
    EXPECT_EQ(technique::opacity_form(step), 0);
  }
}

}  // namespace
}  // namespace triptych::vulkan_backend
