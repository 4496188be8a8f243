#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "scene/compression.hpp"
#include "scene/file_content.hpp"
#include "scene/find_file.hpp"
#include "scene/particle_formats.hpp"
#include "scene/particle_generators.hpp"
#include "scene/particles.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene {
namespace {

constexpr std::string_view particle_generator = "generate:";

struct GeneratedParticles {
  std::string_view name;
  std::uint64_t count;
};

GeneratedParticles parse_generated_particles(std::string_view data) {
  const std::string_view rest = data.substr(particle_generator.size());
  const std::size_t colon = rest.find(':');
  const auto count = colon == std::string_view::npos
                         ? std::nullopt
                         : parse_number<std::uint64_t>(rest.substr(colon + 1));
  if (!count) {
    throw core::InputError(
        fmt::format("'{}': expected generate:NAME:COUNT, where COUNT is a whole number", data));
  }
  return {rest.substr(0, colon), *count};
}

struct Source {
  std::filesystem::path file;
  std::uint64_t frame = 0;
};

// Finds a file with exactly this name. If there is none, parses `data` as FILE@K.
std::optional<Source> find_source(std::string_view data,
                                  const std::vector<std::filesystem::path>& folders) {
  if (const auto file = find_file(data, folders)) return Source{*file, 0};
  const std::size_t at = data.rfind('@');
  if (at == std::string_view::npos) return std::nullopt;
  const auto frame = parse_number<std::uint64_t>(data.substr(at + 1));
  const auto file = find_file(data.substr(0, at), folders);
  if (!file) return std::nullopt;
  if (!frame) {
    throw core::InputError(
        fmt::format("'{}': expected a frame number after '@' (the first frame is 0)", data));
  }
  return Source{*file, *frame};
}

// Removes the byte order mark that some editors put at the beginning of a file. Throws InputError
// for UTF-16.
std::span<const char> without_byte_order_mark(const std::vector<char>& content,
                                              const std::string& file) {
  const std::string_view text(content.data(), content.size());
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    throw core::InputError(
        {.file = file},
        "the file is encoded in UTF-16; expected ASCII or UTF-8; to convert: iconv -f UTF-16 -t "
        "UTF-8 IN > OUT");
  }
  return without_mark(text);
}

// Returns the beginning of the content, which is sufficient to recognize a format.
std::string_view start_of(std::span<const char> content) {
  constexpr std::size_t start_bytes = 4096;
  return {content.data(), std::min(content.size(), start_bytes)};
}

// Converts lines that end with a single CR, as written by old Macintosh programs.
void end_lines_with_lf(std::vector<char>& content) {
  const bool has_lf = std::ranges::find(content, '\n') != content.end();
  if (!has_lf) std::ranges::replace(content, '\r', '\n');
}

ParticleSet read(const Source& source, ColourKind colour, const Progress& progress) {
  const std::string name = source.file.string();
  const bool packed = packing_of_file(source.file) != Packing::none;
  // Decompression counts as this fraction of the progress.
  const double unpacked = packed ? 0.25 : 0;
  const Progress unpacking =
      progress ? Progress([&progress, unpacked](double share) { progress(unpacked * share); })
               : Progress{};
  std::vector<char> content = read_content(source.file, unpacking);
  if (content.empty())
    throw core::InputError({.file = name}, "the file is empty; expected particles");
  const std::span<const char> text = without_byte_order_mark(content, name);
  const ParticleFormat& format = particle_format(name, start_of(text));
  if (format.text) end_lines_with_lf(content);
  const ProgressSteps steps(progress, content.size(), unpacked, 1);
  ParticleSet set =
      format.read({.bytes = text, .file = name, .progress = steps}, source.frame, colour);
  set.facts.format = format.name;
  set.facts.unit = format.unit;
  set.facts.frame = source.frame;
  return set;
}

}  // namespace

ParticleSet load_particles(std::string_view data, ColourKind colour,
                           const std::vector<std::filesystem::path>& folders,
                           const Progress& progress) {
  if (data.starts_with(particle_generator)) {
    const auto [name, count] = parse_generated_particles(data);
    return generate_particles(name, count, colour, progress);
  }
  const auto source = find_source(data, folders);
  if (!source) {
    std::string where;
    for (const auto& folder : folders) where += ", " + folder.string();
    throw core::IoError(
        fmt::format("{}: not found (searched in the current folder{})", data, where));
  }
  ParticleSet set = read(*source, colour, progress);
  if (set.count() == 0 && set.dropped > 0) {
    throw core::InputError(
        {.file = source->file.string()},
        fmt::format(
            "none of the {} particles can be drawn; expected finite positions and radii above 0",
            set.dropped));
  }
  set.name = data;
  set.hash = particle_hash(set);
  if (progress) progress(1);
  return set;
}

void check_generated_particles(std::string_view data) {
  if (!data.starts_with(particle_generator)) return;
  const auto [name, count] = parse_generated_particles(data);
  check_particle_generator(name, count);
}

bool particles_present(std::string_view data, const std::vector<std::filesystem::path>& folders) {
  return data.starts_with(particle_generator) || find_source(data, folders).has_value();
}

}  // namespace triptych::scene
