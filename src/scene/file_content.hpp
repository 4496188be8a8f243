#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "scene/inflate.hpp"
#include "scene/particles.hpp"

namespace triptych::scene {

// What a file holds, unpacked where it is compressed with gzip or bzip2, whatever its name is.
// `progress` gets the share that is done.
// Throws IoError for a file that cannot be read, InputError for a compressed stream that is broken or
// holds more than `most` bytes.
[[nodiscard]] std::vector<char> read_content(const std::filesystem::path& file,
                                             const Progress& progress = {},
                                             std::uint64_t most = most_unpacked_bytes);

}  // namespace triptych::scene
