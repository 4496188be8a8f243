#pragma once
// Writes everything that a driver receives to files, for `render --dump FOLDER`. Backends call
// write_dump() when device code is compiled and when buffers are uploaded.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace triptych::measure {

// The value of the environment variable TRIPTYCH_DUMP; nullopt if nothing is to be written.
[[nodiscard]] std::optional<std::filesystem::path> dump_folder();

// Writes a file into the folder and appends `about` as one line to what-was-given.txt in it, which
// lists everything in the order of the calls. `name` has no extension; a content hash is appended
// to it, so equal contents share one file. Does nothing if dump_folder() is empty. Returns the
// file's name.
std::string write_dump(std::string_view name, std::string_view extension,
                       std::span<const std::byte> content, const std::string& about);
std::string write_dump(std::string_view name, std::string_view extension, std::string_view content,
                       const std::string& about);

// Writes compile.sh into the folder, which compiles the device code in it with public tools.
void write_compile_script(const std::filesystem::path& folder);

}  // namespace triptych::measure
