#include "scene/pdb.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/elements.hpp"

namespace triptych::scene {
namespace {

// Columns as the format counts them, from 1, both included.
std::string_view columns(std::string_view line, std::size_t first, std::size_t last) {
  return line.size() < first ? std::string_view{} : line.substr(first - 1, last - first + 1);
}

// The element in its own columns, or, in files older than those, which have other things or nothing
// there, from the name: its first two columns hold the symbol, adjusted to the right.
std::string element_of(std::string_view line) {
  const std::string_view symbol = trimmed(columns(line, 77, 78));
  if (atomic_number(symbol)) return proper_symbol(symbol);
  const std::string_view name = columns(line, 13, 16);
  const bool two_letters = name.front() != ' ' && (name.front() < '0' || name.front() > '9');
  if (two_letters && trimmed(name).size() < 4 && atomic_number(name.substr(0, 2))) {
    return proper_symbol(name.substr(0, 2));
  }
  return element_from_name(trimmed(name), columns(line, 18, 20));
}

void add_atom(Atoms& atoms, std::string_view line, const LineReader& reader) {
  constexpr std::size_t end_of_place = 54;
  if (line.size() < end_of_place) {
    reader.reject(fmt::format(
        "expected an atom with its place in columns 31 to 54, found {} columns", line.size()));
  }
  atoms.add({reader.number(columns(line, 31, 38), "x in columns 31 to 38"),
             reader.number(columns(line, 39, 46), "y in columns 39 to 46"),
             reader.number(columns(line, 47, 54), "z in columns 47 to 54")},
            atoms.kind(element_of(line)));
}

}  // namespace

ParticleSet read_pdb(LineReader& reader, std::uint64_t frame, ColourKind colour) {
  Atoms atoms;
  std::uint64_t frames = 0;  // that have begun
  bool has_models = false;
  bool in_model = false;
  bool is_entry = false;     // of the PDB
  bool has_heading = false;  // of a whole structure; those with models may leave it at their ends
  bool ended = false;
  while (const auto line = reader.next()) {
    const std::string_view record = trimmed(columns(*line, 1, 6));
    if (record == "ATOM" || record == "HETATM") {
      if (has_models && !in_model) reader.reject("expected MODEL before further atoms");
      // Where nobody writes models, as VMD, END is the end of a frame.
      if (!in_model && (frames == 0 || ended)) ++frames;
      ended = false;
      if (frames - 1 == frame) add_atom(atoms, *line, reader);
    } else if (record == "MODEL") {
      if (in_model) reader.reject("expected ENDMDL before the next MODEL");
      if (frames > 0 && !has_models)
        reader.reject("expected no MODEL after atoms outside of models");
      has_models = in_model = true;
      ++frames;
    } else if (record == "ENDMDL") {
      if (!in_model) reader.reject("ENDMDL without a MODEL");
      in_model = false;
    } else if (record == "HEADER") {
      is_entry = true;
    } else if (record == "TITLE" || record == "CRYST1") {
      has_heading = true;
    } else if (record == "END") {
      ended = true;
    }
  }
  if (in_model) reader.reject("the file ends here, where ENDMDL was expected");
  const bool needs_end = is_entry || (!has_models && (has_heading || frames > 1));
  if (needs_end && !ended) reader.reject("the file ends here, where END was expected");
  if (frame > 0 && frame >= frames) {
    reader.reject(fmt::format("there is no frame {}; the file has {}", frame,
                              std::max<std::uint64_t>(frames, 1)));
  }
  if (atoms.places.empty()) reader.reject("expected ATOM or HETATM records, found none");
  return to_particles(std::move(atoms), colour, reader);
}

}  // namespace triptych::scene
