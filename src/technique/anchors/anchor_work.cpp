#include "technique/anchors/anchor_work.hpp"

#include <fmt/format.h>

#include <numeric>

#include "technique/anchors/shape.hpp"
#include "technique/catalogue.hpp"

namespace triptych::technique {
namespace {

namespace shape = anchor_shape;

// Every API takes this many work-groups, and Mesa's software renderers this many turns of a loop.
constexpr int most_groups = 65535;
constexpr int most_turns = 65535;
// The sum of an invocation's chains stays below 2^24, to which floats hold whole numbers: in OpenCL
// C 64 chains of 255 + 512 steps per size.
constexpr int most_arithmetic = 256;

int most_size(std::string_view technique) {
  if (technique == "anchor_arithmetic") return most_arithmetic;
  if (technique == "anchor_fetch") return most_turns / static_cast<int>(shape::fetch_turns);
  if (technique == "anchor_memory") return most_groups / static_cast<int>(shape::memory_groups);
  if (technique == "anchor_raster") {
    return static_cast<int>(shape::raster_most_layers / shape::raster_layers);
  }
  return most_turns / static_cast<int>(shape::launches);
}

}  // namespace

AnchorFrame anchor_frame(std::string_view technique, int size) {
  const auto times = static_cast<std::uint32_t>(size);
  AnchorFrame frame;
  if (technique == "anchor_arithmetic") {
    frame.parameters = {.work = {shape::arithmetic_turns * times}, .numbers = {1, 1}};
    frame.groups = shape::arithmetic_groups;
    frame.result_words = std::uint64_t{shape::arithmetic_groups} * shape::group;
  } else if (technique == "anchor_fetch") {
    frame.parameters = {.work = {shape::fetch_turns * times}};
    frame.groups = shape::fetch_groups;
    frame.result_words = std::uint64_t{shape::fetch_groups} * shape::group;
    frame.fetches = true;
  } else if (technique == "anchor_memory") {
    frame.parameters = {.work = {shape::memory_key}};
    frame.groups = shape::memory_groups * times;
    frame.result_words = std::uint64_t{frame.groups} * shape::memory_words_a_group;
    frame.source_words = frame.result_words;
  } else if (technique == "anchor_raster") {
    frame.vertices = 3 * shape::raster_triangles_a_layer * shape::raster_layers * times;
  } else {
    frame.launches = shape::launches * times;
  }
  return frame;
}

std::optional<std::string> anchor_size_reason(std::string_view technique, int size) {
  if (triptych::technique::technique(technique).suite != "anchors") {
    return fmt::format("'{}' is no anchor", technique);
  }
  const int most = most_size(technique);
  if (size >= 1 && size <= most) return std::nullopt;
  return fmt::format("{} has sizes from 1 to {}, not {}", technique, most, size);
}

std::vector<std::uint32_t> anchor_source(std::uint64_t words) {
  std::vector<std::uint32_t> source(words);
  std::uint32_t word = 0;
  for (std::uint32_t& each : source) {
    each = word;
    word += 2654435761U;
  }
  return source;
}

std::vector<float> anchor_volume() {
  constexpr std::uint32_t edge = shape::fetch_edge;
  std::vector<float> volume;
  volume.reserve(std::size_t{edge} * edge * edge);
  for (std::uint32_t z = 0; z < edge; ++z) {
    for (std::uint32_t y = 0; y < edge; ++y) {
      for (std::uint32_t x = 0; x < edge; ++x) {
        volume.push_back(static_cast<float>((7 * x + 13 * y + 29 * z) % 128));
      }
    }
  }
  return volume;
}

std::uint32_t anchor_checksum(const std::vector<std::uint32_t>& words) {
  return std::accumulate(words.begin(), words.end(), std::uint32_t{0});
}

}  // namespace triptych::technique
