#pragma once
// Compares a device's results along one ray of a volume with the results of the reference renderer,
// sample by sample and, within each sample, operation by operation. The first difference therefore
// identifies the first operation whose result is outside its bound.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace triptych::accuracy {

// A number that the reference renderer computed, and the interval that must contain the device's
// number.
struct AllowedRange {
  double value = 0;
  double lo = 0;
  double hi = 0;
};

// A sample that the reference renderer takes: a point for the midpoint rule, or a whole step for
// preintegration.
struct ExpectedSample {
  std::int64_t index = 0;
  std::array<AllowedRange, 3> position{};  // in voxels
  std::optional<AllowedRange> front;       // normalised value at the beginning of a step
  AllowedRange value;                    // normalised value at the sample, or at the end of a step
  std::array<AllowedRange, 3> colour{};  // colour after shading, not premultiplied
  std::optional<AllowedRange> alpha;     // opacity per voxel length; not set for a step
  AllowedRange length;                   // in voxel lengths
  AllowedRange opacity;                  // opacity over `length`
};

struct ExpectedRay {
  std::array<double, 3> entry{};        // entry point of the ray into the volume, in voxels
  std::array<double, 3> stride{};       // length of one step, in voxels
  std::vector<ExpectedSample> samples;  // samples of every index from 0 on; empty if the ray misses
  double ends_below = 0;                // transmittance below which a device may end the ray
  // Whether samples may be merged. A merged sample has no counterpart and is not compared.
  bool merges = false;
};

// A sample that the device took.
struct TakenSample {
  std::array<double, 3> position{};
  double front = 0;
  double value = 0;
  std::array<double, 3> colour{};
  double alpha = 0;
  double length = 0;
  double opacity = 0;
  double transmittance = 0;             // transmittance after the sample
  std::array<double, 3> accumulated{};  // premultiplied colour after the sample
};

// The operations of one sample, in the order in which they are computed.
enum class Operation : std::uint8_t {
  sampling,    // the sample is taken once, in the correct order, and not beyond the ray's end
  position,    // the position of the sample
  front,       // the value at the beginning of the step
  value,       // the interpolated value
  alpha,       // the opacity that the transfer function returns
  colour,      // the colour that the transfer function returns, after shading
  length,      // the length of the step that the sample covers
  opacity,     // the opacity over that length
  compositing  // the light after the sample, from the recorded light before it
};
[[nodiscard]] std::string_view name_of(Operation operation);

struct SampleRow {
  std::optional<ExpectedSample> expected;  // nullopt beyond the end of the ray
  std::optional<TakenSample> taken;        // nullopt if the device skipped it or had ended the ray
  std::int64_t index = 0;
  bool compared = true;              // whether the samples were compared; false for merged samples
  std::optional<Operation> differs;  // the first operation whose result is outside its bound
};

struct RayHistory {
  std::vector<SampleRow> rows;       // sorted by index
  std::optional<std::size_t> first;  // the first row that differs
};

// Compares the samples of a ray. If the device took parts of one step separately, the caller must
// have joined them into one sample.
[[nodiscard]] RayHistory compare(const ExpectedRay& expected,
                                 const std::vector<TakenSample>& taken);

}  // namespace triptych::accuracy
