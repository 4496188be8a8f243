#pragma once
// Files that somebody named to be written: refused before work is done for them in vain.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::core {

// Throws IoError when a file could not be created in the folder (made if it is missing), so that
// nothing is measured that could not be kept.
void require_writable(const std::filesystem::path& folder);

// A file and the option or argument that named it.
struct NamedFile {
  std::string_view name;
  std::string file;  // empty: none was named
};

// Throws InputError where a file to be written is one of those to be read, or another that is
// written. What is no regular file, such as /dev/null, may take several.
void refuse_overwriting(const std::vector<NamedFile>& read, const std::vector<NamedFile>& written);

// write_file into a folder that is made if it is missing. Throws IoError.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace triptych::core
