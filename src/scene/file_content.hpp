#pragma once
#include <filesystem>
#include <vector>

#include "scene/particles.hpp"

namespace triptych::scene {

// What a file holds, unpacked where its name ends in .gz; `progress` tells how far that has come.
// Throws IoError for a file that cannot be read, InputError for a broken gzip stream.
[[nodiscard]] std::vector<char> read_content(const std::filesystem::path& file,
                                             const Progress& progress = {});

}  // namespace triptych::scene
