#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::app {

// Folders in which data files are looked for: $TRIPTYCH_DATA and its volumes/ and particles/.
[[nodiscard]] std::vector<std::filesystem::path> data_folders();

// Where baselines are unless told otherwise: ./baselines if it is there, else those installed with
// the program, else those of the source tree.
[[nodiscard]] std::filesystem::path default_baselines();

// This program's own file, to start workers with.
[[nodiscard]] std::string own_program();

// Today, UTC, "YYYY-MM-DD".
[[nodiscard]] std::string today();

// Throws core::IoError when a file could not be created in the folder (made if it is missing), so
// that nothing is measured that could not be kept.
void require_writable(const std::filesystem::path& folder);

// A file and the option or argument that named it.
struct NamedFile {
  std::string_view name;
  std::string file;  // empty: none was named
};

// Throws core::InputError where a file to be written is one of those to be read, or another that is
// written. What is no regular file, such as /dev/null, may take several.
void refuse_overwriting(const std::vector<NamedFile>& read, const std::vector<NamedFile>& written);

// Throws core::NotSupported saying how to measure when there is no such store.
void require_store(const std::filesystem::path& file);

// core::write_file into a folder that is made if it is missing. Throws core::IoError.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace triptych::app
