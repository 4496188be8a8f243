#pragma once
// Files that are compressed as a whole. They are recognized by their first bytes, whatever their
// names are.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "scene/inflate.hpp"

namespace triptych::scene {

enum class Packing : std::uint8_t { none, gzip, bzip2 };

// Determines the compression from the first bytes of a file. Throws InputError for a compression
// that is not supported, with the command that unpacks it.
[[nodiscard]] Packing packing_of(std::span<const std::byte> start, const std::string& file);
[[nodiscard]] std::string_view name_of(Packing packing);

// The unpacked content of `source`. Reading it throws InputError if the stream is broken.
[[nodiscard]] ByteSource unpacked(ByteSource source, Packing packing, const std::string& file);

// The bytes of a file from `start` on, without unpacking. Throws IoError.
[[nodiscard]] ByteSource file_bytes(const std::filesystem::path& file, std::uint64_t start = 0);

// The compression of the whole file, judged by its first bytes; `none` if it is not compressed.
[[nodiscard]] Packing packing_of_file(const std::filesystem::path& file);

// The content of a file, unpacked if it is compressed.
[[nodiscard]] ByteSource content_bytes(const std::filesystem::path& file);

// Up to `most` bytes of a file's content, unpacked, from its beginning.
[[nodiscard]] std::string content_start(const std::filesystem::path& file, std::size_t most);

// Reads and discards `count` bytes, or all remaining ones if there are fewer. Returns the number of
// discarded bytes.
std::uint64_t skip_bytes(const ByteSource& source, std::uint64_t count);

}  // namespace triptych::scene
