#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "scene/inflate.hpp"
#include "scene/particles.hpp"

namespace triptych::scene {

// The content of a file. It is unpacked if it is compressed with gzip or bzip2, whatever the file's
// name is. `progress` is called with the share of the work that is done. Throws IoError for a file
// that cannot be read, and InputError for a compressed stream that is broken or unpacks to more
// than `most` bytes.
[[nodiscard]] std::vector<char> read_content(const std::filesystem::path& file,
                                             const Progress& progress = {},
                                             std::uint64_t most = most_unpacked_bytes);

}  // namespace triptych::scene
