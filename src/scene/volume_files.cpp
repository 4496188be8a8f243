#include <fmt/format.h>

#include <string>

#include "core/error.hpp"
#include "scene/dat.hpp"
#include "scene/find_file.hpp"
#include "scene/generators.hpp"
#include "scene/nrrd.hpp"
#include "scene/text_lines.hpp"
#include "scene/volume.hpp"

namespace triptych::scene {
namespace {

constexpr std::string_view generator_prefix = "generate:";

[[noreturn]] void reject_size(std::string_view data) {
  throw core::InputError(fmt::format(
      "'{}': expected generate:NAME:SIZE or generate:NAME:NXxNYxNZ with whole numbers", data));
}

// "SIZE" or "NXxNYxNZ".
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

struct Generated {
  std::string_view name;
  std::array<int, 3> size;
};

Generated parse_generated(std::string_view data) {
  const std::string_view rest = data.substr(generator_prefix.size());
  const std::size_t colon = rest.find(':');
  if (colon == std::string_view::npos) reject_size(data);
  return {rest.substr(0, colon), parse_size(rest.substr(colon + 1), data)};
}

}  // namespace

Volume load_volume(std::string_view data, const std::vector<std::filesystem::path>& folders) {
  if (data.starts_with(generator_prefix)) {
    const auto [name, size] = parse_generated(data);
    return generate_volume(name, size);
  }
  const auto file = find_file(data, folders);
  if (!file) {
    std::string where;
    for (const auto& folder : folders) where += ", " + folder.string();
    throw core::IoError(fmt::format("{}: not found (looked here{})", data, where));
  }
  const std::string kind = lower_case(file->extension().string());
  Volume volume;
  if (kind == ".nrrd" || kind == ".nhdr") {
    volume = read_nrrd(*file);
  } else if (kind == ".dat") {
    volume = read_dat(*file);
  } else {
    throw core::InputError({.file = file->string()},
                           fmt::format("'{}' is no known kind of volume; expected .nrrd, .nhdr or "
                                       ".dat",
                                       kind));
  }
  volume.name = data;
  return volume;
}

void check_generated_volume(std::string_view data) {
  if (!data.starts_with(generator_prefix)) return;
  const auto [name, size] = parse_generated(data);
  check_volume_generator(name, size);
}

bool is_present(std::string_view data, const std::vector<std::filesystem::path>& folders) {
  return data.starts_with(generator_prefix) || find_file(data, folders).has_value();
}

}  // namespace triptych::scene
