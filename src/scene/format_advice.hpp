#pragma once
// Help for files that cannot be read: the nearest format that can, and the command that makes it.

#include <string>
#include <string_view>

namespace triptych::scene {

// Whether a list of endings, separated by blanks, has this one.
[[nodiscard]] bool has_ending(std::string_view endings, std::string_view ending);

// All endings of the tables, in their order: ".pdb .ent …".
[[nodiscard]] std::string particle_endings();
[[nodiscard]] std::string volume_endings();

// What to do with a file of this ending (".xtc", or empty for none): how to convert it where it is
// of a known program, and which endings are read.
[[nodiscard]] std::string particle_advice(std::string_view ending);
[[nodiscard]] std::string volume_advice(std::string_view ending);

}  // namespace triptych::scene
