#pragma once
// Checks the output files that a user has named, so that unusable files are rejected before any
// work is done.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::core {

// Creates the folder if it is missing. Throws IoError if no file can be created in the folder. Call
// this before measuring, so that no time is spent on results that cannot be stored.
void require_writable(const std::filesystem::path& folder);

// Like require_writable(), for the folder of an output file. A pipe or a device such as /dev/null
// is written in place, so its folder need not be writable.
void require_writable_file(const std::filesystem::path& file);

// A file, and the name of the option or argument that specifies it.
struct NamedFile {
  std::string_view name;
  std::string file;  // empty if the user named no file
};

// Throws InputError if an output file is also an input file, or if two output files are the same
// file. A target that is not a regular file, such as /dev/null, may be used several times.
void refuse_overwriting(const std::vector<NamedFile>& read, const std::vector<NamedFile>& written);

// Like write_file(), but also creates the folder of the file if it is missing. Throws IoError.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace triptych::core
