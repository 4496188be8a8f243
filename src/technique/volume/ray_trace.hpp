#pragma once
// The history of one pixel. A special build of the raycasters (TRI_TRACE) records every sample of
// the pixel's ray. This build has the same counters and the same control flow as the build with
// counters.
//
// The records are stored in the counter buffer, after the counters of all pixels. For the recorded
// pixel, the eighth word of its counters, which is otherwise unused, contains the index of the word
// at which the trace begins. For all other pixels, the eighth word keeps its initial value. The
// trace begins with a word for the capacity in records and a word for the number of records that
// the ray would have written without this limit. The records follow.
// technique/volume/raycast/trace.glsl and backends/opencl/trace.cl write the records.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace triptych::technique {

inline constexpr std::size_t ray_trace_records = 1U << 16U;
inline constexpr std::size_t ray_trace_record_words = 16;
// There are two words before the records, and two words after them because the size of an upload
// must be a multiple of 16 bytes.
inline constexpr std::size_t ray_trace_words = 4 + ray_trace_records * ray_trace_record_words;

// The kind of a record.
enum class TracedKind : std::uint8_t {
  sample = 1,  // one sample, or a run of samples that were merged into one
  step = 2     // a step of quadrature preintegrated, or a part of one
};

// A record. All numbers are as computed on the device and stored as floats; numbers in double
// precision are rounded to float.
struct TracedSample {
  TracedKind kind = TracedKind::sample;
  std::array<float, 3> place{};     // position in voxels; for a step, its middle
  float value = 0;                  // normalised value; for a step, the value at its end
  float front = 0;                  // normalised value at the beginning of a step
  std::array<float, 4> colour{};    // after shading, not premultiplied; alpha: per voxel length
  float length = 0;                 // ray length covered by the sample, in voxel lengths
  float opacity = 0;                // opacity of that length
  float transmittance = 0;          // transmittance after the sample
  std::array<float, 3> gathered{};  // premultiplied colour after the sample
};

struct RayTrace {
  std::vector<TracedSample> samples;  // in the order in which the device took them
  std::uint64_t written = 0;          // total number of records, including those that did not fit
};

// Returns the initial content of the counter buffer for a frame that records the history of pixel
// (x, y), in an image with `pixels` pixels in rows of `width`.
[[nodiscard]] std::vector<std::uint32_t> ray_trace_words_for(int x, int y, int width,
                                                             std::size_t pixels);

// Reads the records from `words`, which is the part of the counter buffer after the counters of all
// pixels.
[[nodiscard]] RayTrace read_ray_trace(std::span<const std::uint32_t> words);

}  // namespace triptych::technique
