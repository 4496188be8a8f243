#pragma once
// Advice for files that cannot be read: the nearest supported format, and the command that converts
// to it.

#include <string>
#include <string_view>

namespace triptych::scene {

// Whether `endings`, a list that is separated by blanks, contains `ending`.
[[nodiscard]] bool has_ending(std::string_view endings, std::string_view ending);

// All endings of the tables, in their order: ".pdb .ent …".
[[nodiscard]] std::string particle_endings();
[[nodiscard]] std::string volume_endings();

// Advice for a file with this ending (".xtc", or empty if the name has none): the command that
// converts the file if its format is known, and the supported endings.
[[nodiscard]] std::string particle_advice(std::string_view ending);
[[nodiscard]] std::string volume_advice(std::string_view ending);

}  // namespace triptych::scene
