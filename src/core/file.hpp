#pragma once
// Functions that read and write whole files. A failed write leaves neither a partial file nor a
// damaged previous file.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::core {

// Reads the whole file. Throws IoError with the system's error message if the file is missing,
// unreadable or a folder. Also rejects pipes and devices, because reading them might never end.
[[nodiscard]] std::vector<std::byte> read_file(const std::filesystem::path& file);

// The size limit for files that people write by hand, such as plans, tables and descriptions.
// Larger files are rejected before they are read.
inline constexpr std::size_t most_text_bytes = std::size_t{1} << 20;
// The size limit for the JSON files that `triptych accept` writes. They may have many lines,
// because they have one value per line, so that people can merge two versions by hand.
inline constexpr std::size_t most_json_bytes = std::size_t{64} << 20;

// Like read_file(), but throws InputError if the file is larger than `most` bytes.
[[nodiscard]] std::string read_text(const std::filesystem::path& file,
                                    std::size_t most = most_text_bytes);

// Writes to a temporary file next to the target and then renames it, so that readers see either the
// old or the new content. A target that is not a regular file (a pipe, a device) is written in
// place. Throws IoError with the system's error message.
void write_file(std::span<const std::byte> bytes, const std::filesystem::path& file);
void write_file(std::string_view text, const std::filesystem::path& file);

struct FileContent {
  std::filesystem::path file;
  std::span<const std::byte> bytes;
};

// Like write_file() for each of the files, but renames none of the temporary files before all of
// them are complete. Therefore a full disk or an unwritable file leaves all previous files as they
// were.
void write_files(const std::vector<FileContent>& files);

}  // namespace triptych::core
