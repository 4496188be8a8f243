#pragma once
// The table of particle formats, with one row for each. docs/adding-a-file-format.md describes how
// to add one.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "scene/particles.hpp"
#include "scene/progress_steps.hpp"

namespace triptych::scene {

// The content of a file, unpacked.
struct ParticleContent {
  std::span<const char> bytes;
  std::string file;
  ProgressSteps progress;
};

struct ParticleFormat {
  std::string_view name;
  std::string_view endings;  // in lower case, separated by blanks; the first one is the usual one
  std::string_view unit;     // unit of lengths; empty if the files do not state one
  // Whether the content can only be of this format, judged by its beginning. Always false for a
  // format whose files begin with free text.
  bool (*begins)(std::string_view start);
  bool text;  // true for lines of text, false for binary data
  ParticleSet (*read)(const ParticleContent& content, std::uint64_t frame, ColourKind colour);
};

[[nodiscard]] std::span<const ParticleFormat> particle_formats();

// Determines the format of a file from its name (without .gz or .bz2) and from the beginning of its
// content. Throws InputError if the name is unknown and the content does not identify a format
// either, or if the content has another format than the name.
[[nodiscard]] const ParticleFormat& particle_format(const std::string& file,
                                                    std::string_view start);

}  // namespace triptych::scene
