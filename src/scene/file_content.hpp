#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "scene/inflate.hpp"
#include "scene/particles.hpp"

namespace triptych::scene {

// What a file holds, unpacked where its name ends in .gz; `progress` tells how far that has come.
// Throws IoError for a file that cannot be read, InputError for a gzip stream that is broken or
// holds more than `most` bytes.
[[nodiscard]] std::vector<char> read_content(const std::filesystem::path& file,
                                             const Progress& progress = {},
                                             std::uint64_t most = most_unpacked_bytes);

}  // namespace triptych::scene
