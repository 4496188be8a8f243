#include "scene/pqr.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "scene/element_names.hpp"

namespace triptych::scene {
namespace {

void add_pqr_atom(Atoms& atoms, const std::vector<std::string_view>& words,
                  const LineReader& reader) {
  // The chain may be missing, or it may be joined to the residue's number.
  if (words.size() != 10 && words.size() != 11) {
    reader.reject(
        fmt::format("expected 'ATOM number name residue [chain] number x y z charge "
                    "radius' (10 or 11 words), found {} words{}",
                    words.size(), reader.truncation_hint()));
  }
  const std::size_t x = words.size() - 5;
  atoms.add({reader.number(words[x], "x"), reader.number(words[x + 1], "y"),
             reader.number(words[x + 2], "z")},
            unnamed_kind(atoms, words[2], words[3]));
  static_cast<void>(reader.number(words[x + 3], "charge"));
  atoms.radii.push_back(reader.number(words[x + 4], "radius"));
}

}  // namespace

ParticleSet read_pqr(LineReader& reader, std::uint64_t frame, ColourKind colour) {
  Atoms atoms;
  std::vector<std::string_view> words;
  std::uint64_t frames = 0;
  bool open = false;
  while (const auto line = reader.next()) {
    split_words_into(*line, words);
    if (words.empty()) continue;
    const std::string record = lower_case(words.front());
    if (record == "atom" || record == "hetatm") {
      if (!open) ++frames;
      open = true;
      if (frames - 1 == frame) add_pqr_atom(atoms, words, reader);
    } else if (record == "end" || record == "endmdl") {
      open = false;
    } else if (record.starts_with("atom") || record.starts_with("hetatm")) {
      reader.reject(fmt::format("expected a blank after ATOM or HETATM, found '{}'",
                                quotable(words.front())));
    }
  }
  if (frame > 0 && frame >= frames) {
    reader.reject(
        fmt::format("there is no frame {}; number of frames in the file: {} (the first is frame 0)",
                    frame, frames));
  }
  if (atoms.places.empty()) reader.reject("expected ATOM or HETATM records, found none");
  atoms.frames = frames;
  name_elements(atoms);
  return to_particles(std::move(atoms), colour, reader);
}

}  // namespace triptych::scene
