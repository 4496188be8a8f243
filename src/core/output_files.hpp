#pragma once
// Checks output files that a user has named, so that an unusable one is refused before any work is
// done.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::core {

// Throws IoError if no file can be created in the folder, which is created if it is missing. Call
// this before measuring, so that nothing is measured that cannot be stored.
void require_writable(const std::filesystem::path& folder);

// A file and the option or argument that named it.
struct NamedFile {
  std::string_view name;
  std::string file;  // empty: none was named
};

// Throws InputError if an output file is also an input file, or is written twice. A target that is
// not a regular file, such as /dev/null, may be written several times.
void refuse_overwriting(const std::vector<NamedFile>& read, const std::vector<NamedFile>& written);

// Like write_file, but creates the folder if it is missing. Throws IoError.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace triptych::core
