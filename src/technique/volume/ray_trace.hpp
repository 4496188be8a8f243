#pragma once
// The history of one pixel: what a build of the raycasters that is made for this purpose
// (TRI_TRACE) records about each sample of the pixel's ray. It counts like the counting build, and
// its control flow is the same.
//
// The records are in the buffer of the counters, after those of all pixels. The eighth word of a
// pixel's counters, which is otherwise unused, contains the index of the word at which the pixel's
// records begin; for all other pixels it keeps the value that counters are filled with. The first
// word there is the number of records for which there is room, and the second one the number of
// records that the ray would have written. technique/volume/raycast/trace.glsl and
// backends/opencl/trace.cl write them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace triptych::technique {

inline constexpr std::size_t ray_trace_records = 1U << 16U;
inline constexpr std::size_t ray_trace_record_words = 16;
// Two words before the records, and two after them, because uploads are multiples of 16 bytes.
inline constexpr std::size_t ray_trace_words = 4 + ray_trace_records * ray_trace_record_words;

// The contents of a record.
enum class TracedKind : std::uint8_t {
  sample = 1,  // one sample; or a run of samples that were merged into one
  step = 2     // a step of quadrature preintegrated, or a part of one
};

// All numbers are the device's, as floats: in double precision they are rounded.
struct TracedSample {
  TracedKind kind = TracedKind::sample;
  std::array<float, 3> place{};     // in voxels; the middle of a step
  float value = 0;                  // normalised; at the end of a step
  float front = 0;                  // at the beginning of a step
  std::array<float, 4> colour{};    // straight, after shading; opacity per voxel length
  float length = 0;                 // voxel lengths that it covers
  float opacity = 0;                // of that length
  float transmittance = 0;          // after it
  std::array<float, 3> gathered{};  // premultiplied colour after it
};

struct RayTrace {
  std::vector<TracedSample> samples;  // in the order in which the device took them
  std::uint64_t written = 0;          // their number, with those for which there was no room
};

// The contents of the buffer before a frame of an image with `pixels` pixels in rows of `width`
// that is to record the history of pixel (x, y).
[[nodiscard]] std::vector<std::uint32_t> ray_trace_words_for(int x, int y, int width,
                                                             std::size_t pixels);

// The records in the words after the counters of all pixels.
[[nodiscard]] RayTrace read_ray_trace(std::span<const std::uint32_t> words);

}  // namespace triptych::technique
