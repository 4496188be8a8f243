#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "scene/find_file.hpp"
#include "scene/generators.hpp"
#include "scene/raw_spec.hpp"
#include "scene/text_lines.hpp"
#include "scene/volume.hpp"
#include "scene/volume_formats.hpp"
#include "scene/voxel_values.hpp"

namespace triptych::scene {
namespace {

constexpr std::string_view volume_generator = "generate:";

[[noreturn]] void reject_size(std::string_view data) {
  throw core::InputError(fmt::format(
      "'{}': expected generate:NAME:SIZE or generate:NAME:NXxNYxNZ with whole numbers", data));
}

// Parses "SIZE" or "NXxNYxNZ".
std::array<int, 3> parse_size(std::string_view text, std::string_view data) {
  std::array<int, 3> size{};
  std::size_t axis = 0;
  for (;;) {
    const std::size_t end = text.find('x');
    const auto n = parse_number<int>(text.substr(0, end));
    if (!n || axis == size.size()) reject_size(data);
    size.at(axis++) = *n;
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  if (axis == 1) size = {size[0], size[0], size[0]};
  if (axis == 2) reject_size(data);
  return size;
}

struct GeneratedVolume {
  std::string_view name;
  std::array<int, 3> size;
};

GeneratedVolume parse_generated_volume(std::string_view data) {
  const std::string_view rest = data.substr(volume_generator.size());
  const std::size_t colon = rest.find(':');
  if (colon == std::string_view::npos) reject_size(data);
  return {rest.substr(0, colon), parse_size(rest.substr(colon + 1), data)};
}

struct VolumeFile {
  std::optional<std::filesystem::path> file;
  std::optional<RawSpec> raw;
};

// Finds a file with exactly this name. If there is none, parses `data` as FILE:SIZE:TYPE.
VolumeFile find_volume(std::string_view data, const std::vector<std::filesystem::path>& folders) {
  if (auto file = find_file(data, folders)) return {.file = std::move(file), .raw = {}};
  auto raw = parse_raw_spec(data);
  if (!raw) return {};
  auto file = find_file(raw->file, folders);
  return {.file = std::move(file), .raw = std::move(raw)};
}

}  // namespace

Component parse_component(std::string_view text) {
  if (text == "magnitude") return {.magnitude = true};
  const auto index = parse_number<std::uint64_t>(text);
  if (!index) {
    throw core::InputError(
        fmt::format("component '{}': expected a 0-based index or 'magnitude'", quotable(text)));
  }
  return {.index = *index};
}

Volume load_volume(std::string_view data, const std::vector<std::filesystem::path>& folders,
                   const Component& component) {
  if (data.starts_with(volume_generator)) {
    const auto [name, size] = parse_generated_volume(data);
    check_component(component, 1, std::filesystem::path(data));
    return generate_volume(name, size);
  }
  const VolumeFile source = find_volume(data, folders);
  if (!source.file) {
    std::string where;
    for (const auto& folder : folders) where += ", " + folder.string();
    throw core::IoError(
        fmt::format("{}: not found (searched in the current folder{})", data, where));
  }
  Volume volume;
  if (source.raw) {
    volume = read_raw(*source.raw, *source.file, component);
  } else {
    const VolumeFormat& format = volume_format(*source.file);
    volume = format.read(*source.file, component);
    volume.facts.format = format.name;
  }
  volume.name = data;
  return volume;
}

void check_generated_volume(std::string_view data) {
  if (!data.starts_with(volume_generator)) {
    static_cast<void>(parse_raw_spec(data));
    return;
  }
  const auto [name, size] = parse_generated_volume(data);
  check_volume_generator(name, size);
}

bool is_present(std::string_view data, const std::vector<std::filesystem::path>& folders) {
  return data.starts_with(volume_generator) || find_volume(data, folders).file.has_value();
}

}  // namespace triptych::scene
