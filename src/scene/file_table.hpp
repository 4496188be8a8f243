#pragma once
#include <string>

#include "scene/transfer_function.hpp"

namespace triptych::scene {

// Returns the content hash of a transfer function that was read from a file, because the file may
// change while its name stays the same. Returns an empty string for a preset, which is identified
// completely by its name.
[[nodiscard]] std::string file_table_hash(const TransferFunction& function);

}  // namespace triptych::scene
