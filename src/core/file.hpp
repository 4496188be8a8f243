#pragma once
// Whole files in and out. A failed write leaves neither half a file nor a damaged older one.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace triptych::core {

// Throws IoError with the system's reason when the file is missing, unreadable or a folder.
[[nodiscard]] std::vector<std::byte> read_file(const std::filesystem::path& file);

// Writes beside the target and renames, so that readers see the old content or the new. A target
// that is no regular file (a pipe, a device) is written in place. Throws IoError with the system's
// reason.
void write_file(std::span<const std::byte> bytes, const std::filesystem::path& file);
void write_file(std::string_view text, const std::filesystem::path& file);

}  // namespace triptych::core
