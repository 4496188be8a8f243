// Stress cases 20 to 30 of the catalogue in docs/accuracy.md, which test transfer functions and
// steps.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "core/random.hpp"
#include "suites/volume/stress_parts.hpp"
#include "suites/volume/stress_scenes.hpp"

namespace triptych::volume_suite {
namespace {

constexpr std::array<float, 4> orange{0.875F, 0.5F, 0.125F, 1};

std::array<float, 4> orange_of(double opacity) {
  return {orange[0], orange[1], orange[2], static_cast<float>(opacity)};
}

StressScene from_within(const scene::TransferFunction& function) {
  StressScene scene = asymmetric_scene();
  scene.camera = camera_looking_at({11.5, 12.25, 13}, {20, 15, 2}, 90);
  scene.function = function;
  return scene;
}

// The bound on an image grows with the number of samples, because each sample may be rounded. With
// 10⁵ or 10⁶ samples, the bound would accept an image in which a third of the samples are missing.
// The number of samples is therefore checked as well. It has a lower limit, because every ray is at
// least as long as the straight way through the volume. At either end of a ray, one sample may
// differ because of rounding.
record::Expectation every_sample(double least_length, double step_voxels) {
  const double least = std::floor(least_length / step_voxels) - 2;
  return {fmt::format("at least {} samples for every ray that hits the volume", least),
          record::CountAtMost{.counter = "rays_hit", .factor = 1 / least, .of = "samples"}};
}

// Returns a scene with a cube of 4³ voxels, seen approximately along its z axis, in an image with
// few rays and many samples along each ray.
StressScene marched(double step_voxels, int pixels) {
  StressScene scene = asymmetric_scene();
  scene.volume = volume_of(
      {4, 4, 4}, [](int i, int j, int k) { return 0.25 + 0.125 * i + 0.0625 * j + 0.03125 * k; });
  scene.camera = camera_looking_at({2, 2.25, 3.875}, {2.125, 1.875, 0}, 30);
  scene.width = scene.height = pixels;
  scene.step_voxels = step_voxels;
  scene.expectations = {every_sample(3.875, step_voxels)};
  return scene;
}

}  // namespace

// The eye is inside the volume. The first sample of every ray hides everything behind it,
// regardless of the length of the sample.
StressScene stress_solid(std::string_view /*variant*/) {
  StressScene scene = from_within(uniform(orange));
  scene.expectations = {
      {"exactly the transfer function's colour, because the opacity of a sample "
       "of length s is 1 − (1 − 1)^s, which is exactly 1",
       record::UniformColour{orange}}};
  return scene;
}

// Each voxel length transmits 2⁻²⁴ of the light. The opacity is converted to the length of a step:
// with square roots for 1/8 voxel (`root`), by squaring for 2 voxels (`square`), and with a
// logarithm and an exponential for any other length.
StressScene stress_nearly_solid(std::string_view variant) {
  StressScene scene = asymmetric_scene();
  scene.function = uniform(orange_of(0x1.fffffep-1));
  scene.step_voxels = variant == "root" ? 0.125 : variant == "square" ? 2 : 0.7;
  return scene;
}

// Each of 10⁵ samples has opacity 2⁻²⁰, so a ray along the cube has a total opacity of 1 − (1 −
// 2⁻²⁰)^100000 = 0.0910.
StressScene stress_faint(std::string_view /*variant*/) {
  constexpr double step = 4e-5;
  StressScene scene = marched(step, 4);
  scene.function = uniform(orange_of(-std::expm1(std::log1p(-0x1.0p-20) / step)));
  return scene;
}

StressScene stress_march(std::string_view variant) {
  StressScene scene = variant == "1e5" ? marched(4e-5, 6) : marched(4e-6, 2);
  scene.function = ramp(0, 0.5);
  return scene;
}

// The step is longer than the volume's diagonal, so that a ray has at most one sample, which covers
// the whole chord. The sample is in the middle of the step, outside the box, where the field is
// constant.
StressScene stress_stride(std::string_view variant) {
  StressScene scene = asymmetric_scene();
  scene.function = ramp(0, 0.1);
  scene.function.entries[0][3] = 0.05F;
  scene.step_voxels = variant == "twice" ? 96 : 30000;
  scene.expectations = {{"one sample per ray",
                         record::CountAtMost{.counter = "samples", .factor = 1, .of = "rays_hit"}}};
  return scene;
}

// Only one entry of 256 is visible. Where the field is steep, a ray passes this entry within 0.4
// steps.
StressScene stress_spike(std::string_view variant) {
  StressScene scene = asymmetric_scene();
  scene.function = uniform(orange_of(0));
  scene.function.entries[variant == "low" ? 30 : 128][3] = 0.9F;
  scene.step_voxels = 2;
  if (variant == "preintegrated") scene.quadrature = scene::Quadrature::preintegrated;
  return scene;
}

// Values up to half an entry beyond the centres of the outermost entries have the colour of those
// entries.
StressScene stress_end_spike(std::string_view variant) {
  const bool first = variant == "first";
  StressScene scene = seen_from_outside(volume_of({16, 16, 16}, [first](int i, int j, int k) {
    const double v = std::min(1.5 * asymmetric_value({16, 16, 16}, i, j, k), 1.0);
    return first ? 1 - v : v;
  }));
  scene.function = uniform(orange_of(0));
  scene.function.entries[first ? 0 : 255][3] = 0.9F;
  return scene;
}

// Opacity is linear along the ray, with a slope that tends to 0. The closed-form solution of such a
// segment (analytic problem v3_segment) divides by the square root of the slope.
StressScene stress_slope(std::string_view variant) {
  double slope = 0;
  std::from_chars(variant.data(), variant.data() + variant.size(), slope);
  StressScene scene = seen_from_outside(
      volume_of({16, 16, 16}, [slope](int i, int, int) { return 0.5 + slope * (i - 7.5); }));
  scene.function = ramp(0, 0.4);
  scene.quadrature = scene::Quadrature::preintegrated;
  return scene;
}

// Only some entries of a random transfer function are visible, in runs as short as one entry.
StressScene stress_edit(std::string_view variant) {
  std::uint64_t seed = 0;
  std::from_chars(variant.data(), variant.data() + variant.size(), seed);
  core::Random random(seed);
  StressScene scene = asymmetric_scene();
  scene.function = uniform({0, 0, 0, 0});
  const int runs = 1 + static_cast<int>(random.uniform() * 4);
  for (int run = 0; run < runs; ++run) {
    const auto first = static_cast<std::size_t>(random.uniform() * 256);
    const auto length = static_cast<std::size_t>(1 + random.uniform() * 40);
    std::array<float, 4> entry{};
    for (float& channel : entry) channel = static_cast<float>(random.uniform());
    for (std::size_t k = first; k < std::min<std::size_t>(first + length, 256); ++k) {
      scene.function.entries[k] = entry;
    }
  }
  return scene;
}

StressScene stress_transparent(std::string_view /*variant*/) {
  StressScene scene = asymmetric_scene();
  scene.function = uniform({1, 1, 1, 0});
  scene.expectations = {{"exactly the background, because nothing is added to 0",
                         record::UniformColour{scene.background}}};
  scene.when_skipping = {
      {"at most one sample per ray, because the last sample may be beyond the last brick, where no "
       "brick marks it as transparent",
       record::CountAtMost{.counter = "samples", .factor = 1, .of = "rays_hit"}}};
  scene.when_leaping = {{"no sample, because no brick is visible",
                         record::CountAtMost{.counter = "samples", .factor = 0}}};
  return scene;
}

StressScene stress_opaque(std::string_view /*variant*/) {
  StressScene scene = asymmetric_scene();
  scene.function = uniform(orange);
  scene.ert = 1.0 / 512;
  scene.expectations = {{"at most two samples per ray, because the first one is opaque",
                         record::CountAtMost{.counter = "samples", .factor = 2, .of = "rays_hit"}}};
  return scene;
}

}  // namespace triptych::volume_suite
