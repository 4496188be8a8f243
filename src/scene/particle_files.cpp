#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "scene/file_content.hpp"
#include "scene/find_file.hpp"
#include "scene/gro.hpp"
#include "scene/lammps.hpp"
#include "scene/mmcif.hpp"
#include "scene/mmpld.hpp"
#include "scene/particle_generators.hpp"
#include "scene/particles.hpp"
#include "scene/pdb.hpp"
#include "scene/xyz.hpp"

namespace triptych::scene {
namespace {

constexpr std::string_view generator_prefix = "generate:";

struct Generated {
  std::string_view name;
  std::uint64_t count;
};

Generated parse_generated(std::string_view data) {
  const std::string_view rest = data.substr(generator_prefix.size());
  const std::size_t colon = rest.find(':');
  const auto count = colon == std::string_view::npos
                         ? std::nullopt
                         : parse_number<std::uint64_t>(rest.substr(colon + 1));
  if (!count) {
    throw core::InputError(
        fmt::format("'{}': expected generate:NAME:COUNT with a whole number", data));
  }
  return {rest.substr(0, colon), *count};
}

struct Source {
  std::filesystem::path file;
  std::uint64_t frame = 0;
};

// A file of that very name, else FILE@K.
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
        fmt::format("'{}': expected the number of a frame after '@', counting from 0", data));
  }
  return Source{*file, *frame};
}

using TextReader = ParticleSet (*)(LineReader&, std::uint64_t, ColourKind);
constexpr std::string_view binary_kind = ".mmpld";
constexpr std::array<std::pair<std::string_view, TextReader>, 8> text_kinds{
    {{".pdb", read_pdb},
     {".cif", read_mmcif},
     {".gro", read_gro},
     {".xyz", read_xyz},
     {".lammpstrj", read_lammps_dump},
     {".dump", read_lammps_dump},
     {".data", read_lammps_data},
     {".lmp", read_lammps_data}}};

// The extension that names the format, without .gz.
std::string kind_of(const std::filesystem::path& file) {
  const std::string last = lower_case(file.extension().string());
  return last == ".gz" ? lower_case(file.stem().extension().string()) : last;
}

// nullptr for the binary kind.
TextReader reader_of(const std::filesystem::path& file) {
  const std::string kind = kind_of(file);
  if (kind == binary_kind) return nullptr;
  for (const auto& [name, reader] : text_kinds) {
    if (kind == name) return reader;
  }
  throw core::InputError(
      {.file = file.string()},
      fmt::format("'{}' is no known kind of particles; expected .pdb, .cif, .gro, .xyz, "
                  ".lammpstrj, .dump, .data, .lmp or .mmpld, plain or .gz",
                  kind));
}

ParticleSet read(const Source& source, ColourKind colour, const Progress& progress) {
  // The share of the progress that unpacking has.
  const double unpacked = lower_case(source.file.extension().string()) == ".gz" ? 0.25 : 0;
  const TextReader reader = reader_of(source.file);
  const Progress unpacking =
      progress ? Progress([&progress, unpacked](double share) { progress(unpacked * share); })
               : Progress{};
  const std::vector<char> content = read_content(source.file, unpacking);
  const std::string name = source.file.string();
  if (content.empty()) throw core::InputError({.file = name}, "is empty; expected particles");
  const ProgressSteps steps(progress, content.size(), unpacked, 1);
  if (reader == nullptr) return read_mmpld(content, name, source.frame, colour, steps);
  LineReader lines({content.data(), content.size()}, name, steps);
  return reader(lines, source.frame, colour);
}

}  // namespace

ParticleSet load_particles(std::string_view data, ColourKind colour,
                           const std::vector<std::filesystem::path>& folders,
                           const Progress& progress) {
  if (data.starts_with(generator_prefix)) {
    const auto [name, count] = parse_generated(data);
    return generate_particles(name, count, colour, progress);
  }
  const auto source = find_source(data, folders);
  if (!source) {
    std::string where;
    for (const auto& folder : folders) where += ", " + folder.string();
    throw core::IoError(fmt::format("{}: not found (looked here{})", data, where));
  }
  ParticleSet set = read(*source, colour, progress);
  if (set.count() == 0 && set.dropped > 0) {
    throw core::InputError({.file = source->file.string()},
                           fmt::format("none of its {} particles can be drawn; expected finite "
                                       "places and a radius above 0",
                                       set.dropped));
  }
  set.name = data;
  set.hash = particle_hash(set);
  if (progress) progress(1);
  return set;
}

void check_generated_particles(std::string_view data) {
  if (!data.starts_with(generator_prefix)) return;
  const auto [name, count] = parse_generated(data);
  check_particle_generator(name, count);
}

bool particles_present(std::string_view data, const std::vector<std::filesystem::path>& folders) {
  return data.starts_with(generator_prefix) || find_source(data, folders).has_value();
}

}  // namespace triptych::scene
