#pragma once
#include <string>

#include "scene/transfer_function.hpp"

namespace triptych::scene {

// The content hash of a transfer function that was read from a file, because the file may change
// while its name stays the same. Empty for a preset, which its name identifies completely.
[[nodiscard]] std::string file_table_hash(const TransferFunction& function);

}  // namespace triptych::scene
