// Stress cases 15 to 19, 31, 32 and 56 of the catalogue in docs/accuracy.md, which test the
// contents of voxels.

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

#include "suites/volume/stress_parts.hpp"
#include "suites/volume/stress_scenes.hpp"

namespace triptych::volume_suite {
namespace {

template <typename Scalar>
void store(scene::Volume& volume, scene::ScalarType type, double scale) {
  const scene::Volume floats = volume;
  volume.type = type;
  volume.voxels.resize(volume.voxel_count() * sizeof(Scalar));
  for (std::size_t i = 0; i < volume.voxel_count(); ++i) {
    const auto value = static_cast<Scalar>(floats.value(i) * scale);
    std::memcpy(volume.voxels.data() + i * sizeof(Scalar), &value, sizeof value);
  }
}

// Returns a scene in which a block of voxels in the bright blob of the asymmetric field has the
// value `value`.
StressScene with_block(double value, int extent) {
  const Size size{24, 24, 24};
  return seen_from_outside(volume_of(size, [&](int i, int j, int k) {
    const bool inside =
        i >= 7 && i < 7 + extent && j >= 14 && j < 14 + extent && k >= 9 && k < 9 + extent;
    return inside ? value : asymmetric_value(size, i, j, k);
  }));
}

// Returns a scene in which every second voxel has the value `value`.
StressScene with_every_second(double value) {
  const Size size{24, 24, 24};
  return seen_from_outside(volume_of(size, [&](int i, int j, int k) {
    return (i + j + k) % 2 == 1 ? value : asymmetric_value(size, i, j, k);
  }));
}

}  // namespace

// The variants store the same 256 values v = 0 … 255 as bytes, as 16-bit integers 257·v and as
// floats. Their normalised values are equal, because v/255 = 257·v/65535.
StressScene stress_format(std::string_view variant) {
  const Size size{24, 24, 24};
  const auto byte = [&](int i, int j, int k) {
    return std::floor(asymmetric_value(size, i, j, k) * 255 + 0.5);
  };
  StressScene scene = seen_from_outside(volume_of(size, byte));
  scene.volume.range_hi = 255;
  if (variant == "u8") store<std::uint8_t>(scene.volume, scene::ScalarType::u8, 1);
  if (variant == "u16") {
    store<std::uint16_t>(scene.volume, scene::ScalarType::u16, 257);
    scene.volume.range_hi = 65535;
  }
  if (variant != "f32") {
    scene.expectations = {same_within_bounds_as("stress:format:f32",
                                                "the image of the same values stored as floats")};
  }
  return scene;
}

// NaN becomes the lower end of the range, where the transfer function is transparent. Within one
// voxel of a NaN, the field is interpolated towards this value. Gradients for shading are affected
// within two voxels.
StressScene stress_nan(std::string_view variant) {
  const bool missing = variant.starts_with("nan");
  const double value = missing ? std::numeric_limits<double>::quiet_NaN() : 0;
  const std::string_view kind = variant.substr(variant.find('_') + 1);
  StressScene scene = kind == "mesh"    ? with_every_second(value)
                      : kind == "block" ? with_block(value, 4)
                                        : with_block(value, 1);
  scene.shaded = kind == "shaded";
  if (missing) {
    scene.expectations = {same_bits_as(
        "stress:nan:zero_" + std::string(kind),
        "an image that is bit-identical to the image of a volume with 0 instead of NaN")};
  }
  return scene;
}

StressScene stress_infinite(std::string_view variant) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (variant == "upper") return with_block(1, 3);
  if (variant == "lower") return with_block(0, 3);
  const bool plus = variant == "plus";
  StressScene scene = with_block(plus ? infinite : -infinite, 3);
  scene.expectations = {same_bits_as(
      plus ? "stress:infinite:upper" : "stress:infinite:lower",
      plus ? "an image that is bit-identical to the image of a volume with the upper end of the "
             "value range instead of ∞"
           : "an image that is bit-identical to the image of a volume with the lower end of the "
             "value range instead of −∞")};
  return scene;
}

// Denormals in the data and in the transfer function are replaced by 0 before they reach a device.
// Denormals that a ray computes may be kept or replaced by 0, which changes no channel of the image
// by more than 2⁻¹²⁶.
StressScene stress_denormal(std::string_view variant) {
  constexpr double tiny = 1e-40;
  if (variant == "voxels") {
    const Size size{24, 24, 24};
    StressScene scene = seen_from_outside(volume_of(size, [&](int i, int j, int k) {
      return i < 12 ? tiny * (1 + j) : asymmetric_value(size, i, j, k);
    }));
    scene.function = uniform({0.75F, 0.5F, 0.25F, 0.03F});
    return scene;
  }
  StressScene scene = asymmetric_scene();
  if (variant == "opacity") {
    scene.function = ramp(20, 0.4);
    for (std::size_t entry = 0; entry < 60; ++entry) scene.function.entries[entry][3] = 1e-40F;
  } else if (variant == "colour") {
    scene.function = uniform({1e-40F, 0.5F, 1e-42F, 0.05F});
  } else {
    // The transmittance passes through the range of denormals, because each voxel transmits 1e-4 of
    // the light, and nothing ends the ray.
    scene.function = uniform({0.75F, 0.5F, 0.25F, 0.9999F});
  }
  return scene;
}

// Values at the limits of half floats. For float data, the smallest value that does not become 0 is
// 2⁻²⁹ of the range.
StressScene stress_halves(std::string_view variant) {
  const Size size{24, 24, 24};
  if (variant == "subnormal") {
    StressScene scene = seen_from_outside(volume_of(size, [&](int i, int j, int k) {
      return i < 12 ? 0x1.0p-31 * (1 + j) : asymmetric_value(size, i, j, k);
    }));
    scene.function = uniform({0.75F, 0.5F, 0.25F, 0.03F});
    return scene;
  }
  const bool largest = variant == "largest";
  const double step = largest ? 32 : 1;
  const double most = largest ? 65504 : 65535;
  StressScene scene = seen_from_outside(volume_of(size, [&](int i, int j, int k) {
    const double x = asymmetric_value(size, i, j, k);
    return x > 0.9 ? most : std::floor(x * most / step) * step;
  }));
  store<std::uint16_t>(scene.volume, scene::ScalarType::u16, 1);
  scene.volume.range_hi = most;
  return scene;
}

// An empty range maps every voxel to 0. A constant field has no gradient to divide by.
StressScene stress_flat(std::string_view variant) {
  const Size size{12, 12, 12};
  const bool bytes = variant == "range_u8";
  StressScene scene =
      seen_from_outside(volume_of(size, [&](int, int, int) { return bytes ? 7 : 0.5; }));
  scene.function = uniform({0.75F, 0.5F, 0.25F, 0.1F});
  scene.function.entries[0] = {0.125F, 0.5F, 0.875F, 0.2F};
  if (bytes) store<std::uint8_t>(scene.volume, scene::ScalarType::u8, 1);
  if (variant.starts_with("range")) {
    scene.volume.range_lo = scene.volume.range_hi = scene.volume.value(0);
  }
  scene.shaded = variant == "shaded";
  return scene;
}

// There is one visible voxel among bricks of 8³ voxels. Samples that read this voxel may be in
// neighbouring bricks.
StressScene stress_lit(std::string_view variant) {
  const Size size{24, 24, 24};
  Size lit{8, 12, 12};  // on a face
  if (variant == "edge") lit = {8, 8, 12};
  if (variant == "corner") lit = {15, 8, 15};
  if (variant == "first") lit = {0, 12, 12};
  if (variant == "last") lit = {23, 23, 23};
  StressScene scene = seen_from_outside(volume_of(size, [&](int i, int j, int k) {
    return Size{i, j, k} == lit ? 1.0 : 0.0;
  }));
  scene.function = ramp(1, 0.99);
  const glm::dvec3 target(lit[0] + 0.5, lit[1] + 0.5, lit[2] + 0.5);
  scene.camera = camera_looking_at(target + glm::dvec3(9, 14, 22), target, 12);
  return scene;
}

// Nothing can be skipped, so walking through the bricks should take hardly any additional samples
// or time.
StressScene stress_lit_everywhere(std::string_view /*variant*/) {
  const Size size{32, 32, 32};
  StressScene scene = seen_from_outside(volume_of(size, [](int i, int j, int k) {
    return i % 8 == 4 && j % 8 == 4 && k % 8 == 4 ? 1.0 : 0.0;
  }));
  scene.function = ramp(1, 0.9);
  scene.when_skipping = {
      {"at most 1.1 times as many samples as without skipping",
       record::CountAtMost{
           .counter = "samples", .factor = 1.1, .of = "samples", .changed = {{"skip", "none"}}}}};
  return scene;
}

}  // namespace triptych::volume_suite
