#pragma once
// The table of particle formats, with one row per format. docs/adding-a-file-format.md describes
// how to add a format.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "scene/particles.hpp"
#include "scene/progress_steps.hpp"

namespace triptych::scene {

// The decompressed content of a file.
struct ParticleContent {
  std::span<const char> bytes;
  std::string file;
  ProgressSteps progress;
};

struct ParticleFormat {
  std::string_view name;
  std::string_view endings;  // in lower case, separated by blanks; the usual ending comes first
  std::string_view unit;     // unit of length; empty if the format does not define a unit
  // Returns whether the beginning of the content identifies this format. Always returns false for
  // formats whose files begin with free text.
  bool (*begins)(std::string_view start);
  bool text;  // true for text, false for binary data
  ParticleSet (*read)(const ParticleContent& content, std::uint64_t frame, ColourKind colour);
};

[[nodiscard]] std::span<const ParticleFormat> particle_formats();

// Determines the format of a file from its name (ignoring .gz or .bz2) and from the beginning of
// its content. Throws InputError if neither the name nor the content identifies a format, or if
// they identify different formats.
[[nodiscard]] const ParticleFormat& particle_format(const std::string& file,
                                                    std::string_view start);

}  // namespace triptych::scene
