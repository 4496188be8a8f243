#pragma once
// Advice for files that cannot be read: the nearest supported format, and the command that converts
// to it.

#include <string>
#include <string_view>

namespace triptych::scene {

// Whether a list of endings, separated by blanks, has this one.
[[nodiscard]] bool has_ending(std::string_view endings, std::string_view ending);

// All endings of the tables, in their order: ".pdb .ent …".
[[nodiscard]] std::string particle_endings();
[[nodiscard]] std::string volume_endings();

// Advice on a file with this ending (".xtc", or empty for none): the command that converts it if
// its format is known, and the supported endings.
[[nodiscard]] std::string particle_advice(std::string_view ending);
[[nodiscard]] std::string volume_advice(std::string_view ending);

}  // namespace triptych::scene
