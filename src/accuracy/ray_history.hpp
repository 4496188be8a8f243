#pragma once
// Compares a device's results along one ray of a volume with the expected results of the reference,
// sample by sample, and within a sample in the order of the computation. The first difference is
// therefore the first operation whose result is outside of its bound.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace triptych::accuracy {

// A number of the reference, and the interval in which the number of a device must lie.
struct Allowed {
  double value = 0;
  double lo = 0;
  double hi = 0;
};

// A sample that the reference takes: a point for the midpoint rule, or a whole step.
struct ExpectedSample {
  std::int64_t index = 0;
  std::array<Allowed, 3> place{};   // in voxels
  std::optional<Allowed> front;     // normalised value at the beginning of a step
  Allowed value;                    // at the sample, or at the end of the step
  std::array<Allowed, 3> colour{};  // straight, after shading
  std::optional<Allowed> alpha;     // opacity per voxel length; not for a step
  Allowed length;                   // in voxel lengths
  Allowed opacity;                  // of that length
};

struct ExpectedRay {
  std::array<double, 3> entry{};        // where the ray enters the volume, in voxels
  std::array<double, 3> stride{};       // length of one step, in voxels
  std::vector<ExpectedSample> samples;  // samples of every index from 0 on; empty if the ray misses
  double ends_below = 0;                // a device may end the ray below this transmittance
  // Samples may be merged: a merged one has no counterpart and is not compared.
  bool merges = false;
};

// A sample of the device.
struct TakenSample {
  std::array<double, 3> place{};
  double front = 0;
  double value = 0;
  std::array<double, 3> colour{};
  double alpha = 0;
  double length = 0;
  double opacity = 0;
  double transmittance = 0;          // after it
  std::array<double, 3> gathered{};  // premultiplied colour after it
};

// The operations of one sample, in their order.
enum class Operation : std::uint8_t {
  take,        // the sample is taken: once, in its order, and not beyond the end of the ray
  place,       // where it is
  front,       // the value at the beginning of the step
  value,       // the interpolated value
  alpha,       // the opacity that the transfer function returns
  colour,      // the colour that it returns, and shading
  length,      // the length of the step that the sample covers
  opacity,     // the opacity of that length
  compositing  // the light after it, from the light before it as the device recorded that
};
[[nodiscard]] std::string_view name_of(Operation operation);

struct SampleRow {
  std::optional<ExpectedSample> expected;  // none beyond the end of the ray
  std::optional<TakenSample> taken;        // none if the device skipped it, or ended the ray
  std::int64_t index = 0;
  bool compared = true;              // false for merged samples
  std::optional<Operation> differs;  // the first one whose result is outside of its bound
};

struct RayHistory {
  std::vector<SampleRow> rows;       // by index
  std::optional<std::size_t> first;  // the first row that differs
};

// Parts of one step that the device took one after the other must have been joined before.
[[nodiscard]] RayHistory compare(const ExpectedRay& expected,
                                 const std::vector<TakenSample>& taken);

}  // namespace triptych::accuracy
