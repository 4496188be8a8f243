#include "scene/particle_formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "scene/format_advice.hpp"
#include "scene/gro.hpp"
#include "scene/lammps.hpp"
#include "scene/line_reader.hpp"
#include "scene/mmcif.hpp"
#include "scene/mmpld.hpp"
#include "scene/pdb.hpp"
#include "scene/pqr.hpp"
#include "scene/text_lines.hpp"
#include "scene/xyz.hpp"

namespace triptych::scene {
namespace {

template <auto read_text>
ParticleSet read_lines(const ParticleContent& content, std::uint64_t frame, ColourKind colour) {
  LineReader lines({content.bytes.data(), content.bytes.size()}, content.file, content.progress);
  return read_text(lines, frame, colour);
}

ParticleSet read_binary_mmpld(const ParticleContent& content, std::uint64_t frame,
                              ColourKind colour) {
  return read_mmpld(content.bytes, content.file, frame, colour, content.progress);
}

bool begins_as_pdb(std::string_view start) {
  constexpr std::array<std::string_view, 5> records{"HEADER    ", "CRYST1", "ATOM      ", "HETATM ",
                                                    "MODEL     "};
  return std::ranges::any_of(records, [&](auto record) { return start.starts_with(record); });
}

bool begins_as_cif(std::string_view start) {
  for (;;) {
    start.remove_prefix(std::min(start.find_first_not_of(" \t\r\n"), start.size()));
    if (!start.starts_with('#')) break;
    start.remove_prefix(std::min(start.find('\n'), start.size()));
  }
  return lower_case(start.substr(0, 5)) == "data_";
}

bool begins_as_dump(std::string_view start) {
  return start.starts_with("ITEM: ");
}

bool begins_as_mmpld(std::string_view start) {
  return start.starts_with("MMPLD");
}

bool never(std::string_view /*start*/) {
  return false;
}

constexpr std::array<ParticleFormat, 8> formats{
    {{"PDB", ".pdb .ent .pdb1 .pdb2 .pdb3 .pdb4 .pdb5 .brk", "Å", begins_as_pdb, true,
      read_lines<read_pdb>},
     {"mmCIF", ".cif .mmcif .pdbx", "Å", begins_as_cif, true, read_lines<read_mmcif>},
     {"PQR", ".pqr", "Å", never, true, read_lines<read_pqr>},
     {"GROMACS", ".gro", "nm", never, true, read_lines<read_gro>},
     {"XYZ", ".xyz .extxyz .exyz", "Å", never, true, read_lines<read_xyz>},
     {"LAMMPS dump", ".lammpstrj .dump .lammpsdump", "", begins_as_dump, true,
      read_lines<read_lammps_dump>},
     {"LAMMPS data", ".data .lmp .lammps .lmpdat", "", never, true, read_lines<read_lammps_data>},
     {"MMPLD", ".mmpld", "", begins_as_mmpld, false, read_binary_mmpld}}};

// Returns the file name ending that determines the format, ignoring the ending of a compressed
// file.
std::string ending_of(const std::filesystem::path& file) {
  const std::string last = lower_case(file.extension().string());
  const bool packed = last == ".gz" || last == ".bz2";
  return packed ? lower_case(file.stem().extension().string()) : last;
}

// Returns whether files of the two formats can begin in the same way. This is true of PQR and PDB,
// because both have the same records.
bool have_same_beginning(const ParticleFormat& named, const ParticleFormat& begun) {
  return named.name == "PQR" && begun.name == "PDB";
}

}  // namespace

std::span<const ParticleFormat> particle_formats() {
  return formats;
}

const ParticleFormat& particle_format(const std::string& file, std::string_view start) {
  const std::string ending = ending_of(file);
  const auto named = std::ranges::find_if(
      formats, [&](const ParticleFormat& format) { return has_ending(format.endings, ending); });
  const auto begun = std::ranges::find_if(
      formats, [&](const ParticleFormat& format) { return format.begins(start); });
  if (named == formats.end() && begun == formats.end()) {
    throw core::InputError({.file = file}, particle_advice(ending, start));
  }
  if (named == formats.end()) return *begun;
  if (begun == formats.end() || begun == named || have_same_beginning(*named, *begun))
    return *named;
  // Some endings, such as .lammps and .data, are used for both LAMMPS formats.
  if (begun->name == "LAMMPS dump" && named->name == "LAMMPS data") return *begun;
  throw core::InputError(
      {.file = file},
      fmt::format("the file extension indicates the format {} ({}), but the content looks like "
                  "{}; if the content is correct, change the extension to {}",
                  named->name, ending, begun->name, split_words(begun->endings).front()));
}

}  // namespace triptych::scene
