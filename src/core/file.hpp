#pragma once
// Reads and writes whole files. A failed write leaves neither half a file nor a damaged older one.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::core {

// Throws IoError with the system's reason if the file is missing, unreadable or a folder. Also
// throws for a pipe or a device, which might never end.
[[nodiscard]] std::vector<std::byte> read_file(const std::filesystem::path& file);

// The limit for files that people write, such as plans, tables and descriptions. Larger files are
// refused before they are read.
inline constexpr std::size_t most_text_bytes = std::size_t{1} << 20;
// The limit for JSON files that `accept` writes with one value per line, and that people merge by
// hand.
inline constexpr std::size_t most_json_bytes = std::size_t{64} << 20;

// Like read_file, but throws InputError for a file of more than `most` bytes.
[[nodiscard]] std::string read_text(const std::filesystem::path& file,
                                    std::size_t most = most_text_bytes);

// Writes to a temporary file beside the target and renames it, so that readers see either the old
// or the new content. A target that is not a regular file (a pipe, a device) is written in place.
// Throws IoError with the system's reason.
void write_file(std::span<const std::byte> bytes, const std::filesystem::path& file);
void write_file(std::string_view text, const std::filesystem::path& file);

}  // namespace triptych::core
