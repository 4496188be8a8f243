#pragma once
// The table of particle formats: one row each. docs/adding-a-file-format.md says how to add one.

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
  std::string_view endings;  // in small letters, separated by blanks; the first one is the usual one
  std::string_view unit;     // of lengths; empty where the files do not state one
  // Whether content that begins like this is of this format beyond doubt; never true for a format
  // whose files begin with free text.
  bool (*begins)(std::string_view start);
  bool text;  // lines, and not bytes
  ParticleSet (*read)(const ParticleContent& content, std::uint64_t frame, ColourKind colour);
};

[[nodiscard]] std::span<const ParticleFormat> particle_formats();

// The format of a file by its name, without .gz or .bz2, and by how its content begins. Throws
// InputError for a name that no format has, where its content is of none either; and for content
// that is of another format than the name says.
[[nodiscard]] const ParticleFormat& particle_format(const std::string& file,
                                                    std::string_view start);

}  // namespace triptych::scene
