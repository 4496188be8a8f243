#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "scene/inflate.hpp"
#include "scene/particles.hpp"

namespace triptych::scene {

// Returns the content of a file. A file that is compressed with gzip or bzip2 is decompressed,
// regardless of its name. `progress` is called with the completed fraction of the work. Throws
// IoError if the file cannot be read, and InputError if a compressed stream is damaged or
// decompresses to more than `most` bytes.
[[nodiscard]] std::vector<char> read_content(const std::filesystem::path& file,
                                             const Progress& progress = {},
                                             std::uint64_t most = most_unpacked_bytes);

}  // namespace triptych::scene
