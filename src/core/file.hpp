#pragma once
// Whole files in and out. A failed write leaves neither half a file nor a damaged older one.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::core {

// Throws IoError with the system's reason when the file is missing, unreadable or a folder, and at
// once where it is a pipe or a device, which may never end.
[[nodiscard]] std::vector<std::byte> read_file(const std::filesystem::path& file);

// What people write: plans, tables, descriptions. Larger ones are refused before they are read.
inline constexpr std::size_t most_text_bytes = std::size_t{1} << 20;
// What accept writes and people merge: a line per value.
inline constexpr std::size_t most_json_bytes = std::size_t{64} << 20;

// As read_file, and InputError for a file of more than `most` bytes.
[[nodiscard]] std::string read_text(const std::filesystem::path& file,
                                    std::size_t most = most_text_bytes);

// Writes beside the target and renames, so that readers see the old content or the new. A target
// that is no regular file (a pipe, a device) is written in place. Throws IoError with the system's
// reason.
void write_file(std::span<const std::byte> bytes, const std::filesystem::path& file);
void write_file(std::string_view text, const std::filesystem::path& file);

}  // namespace triptych::core
