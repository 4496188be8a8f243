#pragma once
// Advice for files that cannot be read: the closest supported format, and a command that converts
// the file to it.

#include <string>
#include <string_view>

namespace triptych::scene {

// Returns whether `endings`, a list separated by blanks, contains `ending`.
[[nodiscard]] bool has_ending(std::string_view endings, std::string_view ending);

// Return all supported file name endings, in the order of the format tables: ".pdb .ent …".
[[nodiscard]] std::string particle_endings();
[[nodiscard]] std::string volume_endings();

// Return the reason why a file is not read: its format is unknown. `ending` is the ending of its
// name (such as ".xtc", or empty if the name has no ending), and `start` is the beginning of its
// content. The reason names the other suite if the file has a format of that suite. Otherwise it
// contains a command that converts the file if its format is known, and the supported endings.
[[nodiscard]] std::string particle_advice(std::string_view ending, std::string_view start);
[[nodiscard]] std::string volume_advice(std::string_view ending, std::string_view start);

}  // namespace triptych::scene
