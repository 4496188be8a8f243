#pragma once
// Writes everything that a driver receives to files, for `render --dump FOLDER`. Backends call
// write_dump() when they compile device code and when they upload buffers.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace triptych::measure {

// Returns the folder that the environment variable TRIPTYCH_DUMP names, or nullopt if the variable
// is not set, which means that nothing is to be written.
[[nodiscard]] std::optional<std::filesystem::path> dump_folder();

// Writes a file to the dump folder. The file's name consists of `name`, a content hash and
// `extension`, so equal contents share one file. Also appends a line with the file's name and
// `about` to what-was-given.txt in that folder, which therefore lists all files in the order of the
// calls. Returns the file's name. Does nothing if dump_folder() returns nullopt.
std::string write_dump(std::string_view name, std::string_view extension,
                       std::span<const std::byte> content, const std::string& about);
std::string write_dump(std::string_view name, std::string_view extension, std::string_view content,
                       const std::string& about);

// Writes the script compile.sh to the folder. The script checks the device code in the folder with
// tools that do not belong to the driver: spirv-val, glslangValidator and clang.
void write_compile_script(const std::filesystem::path& folder);

}  // namespace triptych::measure
