#pragma once
// The history of one pixel. A special build of the raycasters (TRI_TRACE) records every sample of
// the pixel's ray. It counts like the counting build and has the same control flow.
//
// The records are in the buffer of the counters, after the counters of all pixels. The eighth word
// of a pixel's counters, which is otherwise unused, contains the index of the word at which the
// pixel's records begin. For all other pixels it keeps the value that counters are filled with. The
// first word at that index is the number of records for which there is room, and the second one the
// number of records that the ray would have written. technique/volume/raycast/trace.glsl and
// backends/opencl/trace.cl write the records.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace triptych::technique {

inline constexpr std::size_t ray_trace_records = 1U << 16U;
inline constexpr std::size_t ray_trace_record_words = 16;
// There are two words before the records, and two after them because uploads are multiples of 16
// bytes.
inline constexpr std::size_t ray_trace_words = 4 + ray_trace_records * ray_trace_record_words;

// The contents of a record.
enum class TracedKind : std::uint8_t {
  sample = 1,  // one sample, or a run of samples that were merged into one
  step = 2     // a step of quadrature preintegrated, or a part of one
};

// All numbers are the device's, stored as floats, so those in double precision are rounded.
struct TracedSample {
  TracedKind kind = TracedKind::sample;
  std::array<float, 3> place{};     // position in voxels; the middle of a step
  float value = 0;                  // normalised; at the end of a step
  float front = 0;                  // at the beginning of a step
  std::array<float, 4> colour{};    // not premultiplied, after shading; opacity per voxel length
  float length = 0;                 // length that it covers, in voxel lengths
  float opacity = 0;                // opacity of that length
  float transmittance = 0;          // transmittance after the sample
  std::array<float, 3> gathered{};  // premultiplied colour after the sample
};

struct RayTrace {
  std::vector<TracedSample> samples;  // in the order in which the device took them
  std::uint64_t written = 0;          // total number of records, including those without room
};

// The initial content of the buffer for a frame that records the history of pixel (x, y), for an
// image with `pixels` pixels in rows of `width`.
[[nodiscard]] std::vector<std::uint32_t> ray_trace_words_for(int x, int y, int width,
                                                             std::size_t pixels);

// Reads the records from the words after the counters of all pixels.
[[nodiscard]] RayTrace read_ray_trace(std::span<const std::uint32_t> words);

}  // namespace triptych::technique
