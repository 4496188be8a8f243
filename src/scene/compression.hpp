#pragma once
// Reads files that are compressed as a whole. Compression is recognized by a file's first bytes,
// regardless of its name.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "scene/inflate.hpp"

namespace triptych::scene {

enum class Packing : std::uint8_t { none, gzip, bzip2 };

// Determines the compression from the first bytes of a file. Throws InputError for an unsupported
// compression. The message contains a command that decompresses the file.
[[nodiscard]] Packing packing_of(std::span<const std::byte> start, const std::string& file);
[[nodiscard]] std::string_view name_of(Packing packing);

// Returns the decompressed content of `source`. Reading it throws InputError if the stream is
// damaged.
[[nodiscard]] ByteSource unpacked(ByteSource source, Packing packing, const std::string& file);

// Returns the file's bytes from offset `start`, without decompressing them. Throws IoError.
[[nodiscard]] ByteSource file_bytes(const std::filesystem::path& file, std::uint64_t start = 0);

// Returns the compression of a file, judged by its first bytes, or `none` if the file is not
// compressed.
[[nodiscard]] Packing packing_of_file(const std::filesystem::path& file);

// Returns the content of a file, decompressed if necessary.
[[nodiscard]] ByteSource content_bytes(const std::filesystem::path& file);

// Returns up to `most` bytes from the beginning of a file's decompressed content.
[[nodiscard]] std::string content_start(const std::filesystem::path& file, std::size_t most);

// Reads and discards `count` bytes, or all remaining bytes if there are fewer. Returns the number
// of discarded bytes.
std::uint64_t skip_bytes(const ByteSource& source, std::uint64_t count);

}  // namespace triptych::scene
