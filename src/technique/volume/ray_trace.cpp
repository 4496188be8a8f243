#include "technique/volume/ray_trace.hpp"

#include <algorithm>
#include <bit>

#include "technique/volume/raycast_parameters.hpp"

namespace triptych::technique {
namespace {

TracedSample read_record(std::span<const std::uint32_t> words) {
  const auto number = [&](std::size_t at) { return std::bit_cast<float>(words[at]); };
  return {.kind = words[0] == 2 ? TracedKind::step : TracedKind::sample,
          .place = {number(1), number(2), number(3)},
          .value = number(4),
          .front = number(5),
          .colour = {number(6), number(7), number(8), number(9)},
          .length = number(10),
          .opacity = number(11),
          .transmittance = number(12),
          .gathered = {number(13), number(14), number(15)}};
}

}  // namespace

std::vector<std::uint32_t> ray_trace_words_for(int x, int y, int width, std::size_t pixels) {
  constexpr std::uint32_t unwritten = 0xFFFFFFFF;
  const std::size_t counters = raycast_counter_stride * pixels;
  const std::size_t pixel =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  std::vector<std::uint32_t> words(counters + ray_trace_words, unwritten);
  words.at(raycast_counter_stride * pixel + raycast_counters.size()) =
      static_cast<std::uint32_t>(counters);
  words[counters] = static_cast<std::uint32_t>(ray_trace_records);
  words[counters + 1] = 0;
  return words;
}

RayTrace read_ray_trace(std::span<const std::uint32_t> words) {
  RayTrace trace{.samples = {}, .written = words[1]};
  const auto kept = std::min<std::uint64_t>(trace.written, ray_trace_records);
  for (std::size_t n = 0; n < kept; ++n) {
    trace.samples.push_back(
        read_record(words.subspan(2 + n * ray_trace_record_words, ray_trace_record_words)));
  }
  return trace;
}

}  // namespace triptych::technique
