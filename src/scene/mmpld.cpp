#include "scene/mmpld.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "scene/line_reader.hpp"
#include "scene/particle_colours.hpp"

namespace triptych::scene {
namespace {

static_assert(std::endian::native == std::endian::little,
              "reading MMPLD files requires a little-endian machine, because their numbers are "
              "little-endian");

enum class VertexType : std::uint8_t { none, float_xyz, float_xyzr, short_xyz, double_xyz };
enum class ColourType : std::uint8_t {
  none,
  rgb8,
  rgba8,
  float_intensity,
  float_rgb,
  float_rgba,
  ushort_rgba,
  double_intensity
};
constexpr std::array<std::size_t, 5> vertex_bytes{0, 12, 16, 6, 24};
constexpr std::array<std::size_t, 8> colour_bytes{0, 3, 4, 4, 12, 16, 8, 8};

// Reads numbers from the current position in the data. Every read is checked against the end of the
// data.
class Bytes {
 public:
  Bytes(std::span<const char> content, std::string file)
      : content_(content), file_(std::move(file)) {}

  template <typename T>
  T read(std::string_view what) {
    need(sizeof(T), what);
    T value;
    std::memcpy(&value, content_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }
  std::span<const char> read_many(std::uint64_t count, std::size_t each, std::string_view what) {
    if (each > 0 && count > (content_.size() - at_) / each) need(content_.size() + 1, what);
    const auto bytes = content_.subspan(at_, static_cast<std::size_t>(count) * each);
    at_ += bytes.size();
    return bytes;
  }
  void move_to(std::uint64_t at) { at_ = static_cast<std::size_t>(at); }
  [[nodiscard]] std::uint64_t at() const { return at_; }
  [[nodiscard]] std::uint64_t size() const { return content_.size(); }

  [[noreturn]] void reject(const std::string& message) const {
    throw core::InputError({.file = file_}, fmt::format("byte {}: {}", at_, message));
  }

 private:
  void need(std::size_t bytes, std::string_view what) const {
    if (bytes > content_.size() - at_) {
      reject(fmt::format("unexpected end of file at byte {}; expected {}", content_.size(), what));
    }
  }

  std::span<const char> content_;
  std::size_t at_ = 0;
  std::string file_;
};

struct List {
  VertexType vertex = VertexType::none;
  ColourType colour = ColourType::none;
  float radius = 0;  // for all particles without an individual radius
  Rgb rgb{};         // for all particles without an individual colour
  double lo = 0;     // the range of the intensities is [lo, hi]
  double hi = 1;
  std::uint64_t count = 0;
  std::span<const char> data;

  [[nodiscard]] std::size_t stride() const {
    return vertex_bytes.at(static_cast<std::size_t>(vertex)) +
           colour_bytes.at(static_cast<std::size_t>(colour));
  }
};

List read_list(Bytes& bytes, int version) {
  List list;
  const auto vertex = bytes.read<std::uint8_t>("a vertex type");
  const auto colour = bytes.read<std::uint8_t>("a colour type");
  if (vertex >= vertex_bytes.size()) {
    bytes.reject(fmt::format("expected a vertex type from 0 to 4, found {}", vertex));
  }
  if (colour >= colour_bytes.size()) {
    bytes.reject(fmt::format("expected a colour type from 0 to 7, found {}", colour));
  }
  list.vertex = static_cast<VertexType>(vertex);
  list.colour = static_cast<ColourType>(colour);
  if (list.vertex != VertexType::none && list.vertex != VertexType::float_xyzr) {
    list.radius = bytes.read<float>("the list's radius");
  }
  if (list.colour == ColourType::none) {
    const auto rgba = bytes.read<std::array<std::uint8_t, 4>>("the list's colour");
    for (std::size_t i = 0; i < 3; ++i) list.rgb.at(i) = rgba.at(i) / 255.0;
  }
  if (list.colour == ColourType::float_intensity || list.colour == ColourType::double_intensity) {
    list.lo = bytes.read<float>("the list's lowest intensity");
    list.hi = bytes.read<float>("the list's highest intensity");
  }
  list.count = bytes.read<std::uint64_t>("the list's number of particles");
  if (list.count > most_particles) {
    bytes.reject(
        fmt::format("too many particles: {} (the limit is {})", list.count, most_particles));
  }
  if (list.vertex == VertexType::none && list.count > 0) {
    bytes.reject(fmt::format("expected a list with positions, found {} particles without positions",
                             list.count));
  }
  if (version >= 103) static_cast<void>(bytes.read_many(6, sizeof(float), "the list's box"));
  list.data = bytes.read_many(list.count, list.stride(), "the list's particles");
  if (version == 101) {  // skips the clusters: their number, the size of their data, and the data
    static_cast<void>(bytes.read<std::uint32_t>("the number of clusters"));
    const auto size = bytes.read<std::uint64_t>("the size of the clusters");
    static_cast<void>(bytes.read_many(size, 1, "the clusters"));
  }
  return list;
}

struct FrameTable {
  std::uint32_t frames = 0;
  std::uint64_t end = 0;  // the position at which the requested frame ends
};

// Reads the file up to the requested frame, and leaves the position at its beginning.
FrameTable find_frame(Bytes& bytes, std::uint64_t frame, int& version) {
  constexpr std::array<char, 6> magic{'M', 'M', 'P', 'L', 'D', '\0'};
  if (bytes.read<std::array<char, 6>>("'MMPLD'") != magic) {
    bytes.move_to(0);
    bytes.reject("expected 'MMPLD' and a zero byte");
  }
  version = bytes.read<std::uint16_t>("the version");
  if (version < 100 || version > 103) {
    bytes.reject(fmt::format("expected a version from 100 to 103, found {}", version));
  }
  const auto frames = bytes.read<std::uint32_t>("the number of frames");
  static_cast<void>(bytes.read_many(12, sizeof(float), "the data box and the clipping box"));
  const std::uint64_t table = bytes.at();
  const auto offsets = bytes.read_many(std::uint64_t{frames} + 1, 8, "the frame table");
  if (frame >= frames) {
    bytes.reject(
        fmt::format("there is no frame {}; number of frames in the file: {} (the first is frame 0)",
                    frame, frames));
  }
  std::array<std::uint64_t, 2> range{};
  std::memcpy(range.data(), offsets.data() + frame * 8, sizeof(range));
  if (range[0] < table + offsets.size() || range[1] < range[0] || range[1] > bytes.size()) {
    bytes.move_to(table + frame * 8);
    bytes.reject(
        fmt::format("frame {} must lie between byte {} and the end of the file at byte {}, but "
                    "the frame table places it at bytes {} to {}",
                    frame, table + offsets.size(), bytes.size(), range[0], range[1]));
  }
  bytes.move_to(range[0]);
  return {frames, range[1]};
}

template <typename T, std::size_t N>
std::array<double, N> load(const char* from) {
  std::array<T, N> stored;
  std::memcpy(stored.data(), from, sizeof(stored));
  std::array<double, N> values{};
  std::ranges::copy(stored, values.begin());
  return values;
}

std::array<double, 4> sphere_of(const List& list, const char* from) {
  std::array<double, 3> place{};
  switch (list.vertex) {
    case VertexType::none:
      break;
    case VertexType::float_xyz:
      place = load<float, 3>(from);
      break;
    case VertexType::float_xyzr:
      return load<float, 4>(from);
    case VertexType::short_xyz:
      place = load<std::int16_t, 3>(from);
      break;
    case VertexType::double_xyz:
      place = load<double, 3>(from);
      break;
  }
  return {place[0], place[1], place[2], list.radius};
}

double channel(double value) {
  return std::isnan(value) ? 0 : std::clamp(value, 0.0, 1.0);
}

struct Colour {
  Rgb rgb{};
  std::optional<double> intensity;  // the particle's own value, if the file has one
};

Colour grey(const List& list, double value) {
  const double x = channel(list.hi > list.lo ? (value - list.lo) / (list.hi - list.lo) : value);
  return {{x, x, x}, x};
}

template <typename T>
Colour scaled(const char* from) {
  const auto values = load<T, 3>(from);
  const double one = std::is_integral_v<T> ? static_cast<double>(std::numeric_limits<T>::max()) : 1;
  return {{channel(values[0] / one), channel(values[1] / one), channel(values[2] / one)}, {}};
}

Colour colour_of(const List& list, const char* from) {
  switch (list.colour) {
    case ColourType::none:
      break;
    case ColourType::rgb8:
    case ColourType::rgba8:
      return scaled<std::uint8_t>(from);
    case ColourType::float_intensity:
      return grey(list, load<float, 1>(from)[0]);
    case ColourType::float_rgb:
    case ColourType::float_rgba:
      return scaled<float>(from);
    case ColourType::ushort_rgba:
      return scaled<std::uint16_t>(from);
    case ColourType::double_intensity:
      return grey(list, load<double, 1>(from)[0]);
  }
  return {list.rgb, {}};
}

}  // namespace

ParticleSet read_mmpld(std::span<const char> content, const std::string& file, std::uint64_t frame,
                       ColourKind colour, ProgressSteps progress) {
  Bytes bytes(content, file);
  int version = 0;
  const auto [frames, end] = find_frame(bytes, frame, version);
  if (version >= 102) static_cast<void>(bytes.read<float>("the frame's time"));
  const auto list_count = bytes.read<std::uint32_t>("the number of lists");
  std::vector<List> lists;
  std::uint64_t total = 0;
  for (std::uint32_t i = 0; i < list_count; ++i) {
    lists.push_back(read_list(bytes, version));
    total += lists.back().count;
  }
  if (bytes.at() != end) {
    bytes.reject(
        fmt::format("expected the frame to end at byte {}, as declared in the frame table", end));
  }
  if (total == 0) bytes.reject("expected particles, found none");
  if (total > most_particles) {
    bytes.reject(fmt::format("too many particles: {} (the limit is {})", total, most_particles));
  }
  ParticleSet set;
  set.colour = colour;
  set.facts.frames = frames;
  reserve(set, static_cast<std::size_t>(total));
  std::uint32_t id = 0;
  for (std::size_t index = 0; index < lists.size(); ++index) {
    const List& list = lists[index];
    const std::size_t colour_at = vertex_bytes.at(static_cast<std::size_t>(list.vertex));
    for (std::uint64_t i = 0; i < list.count; ++i, ++id) {
      const char* particle = list.data.data() + i * list.stride();
      progress.advance_to(static_cast<std::uint64_t>(particle - content.data()));
      if (!append(set, sphere_of(list, particle), id)) continue;
      const Colour shown = colour_of(list, particle + colour_at);
      const double rank = lists.size() > 1
                              ? static_cast<double>(index) / static_cast<double>(lists.size())
                              : static_cast<double>(id) / static_cast<double>(total);
      append_colour(set, shown.rgb, shown.intensity.value_or(rank));
    }
  }
  return set;
}

}  // namespace triptych::scene
