#pragma once
#include <string>

#include "scene/transfer_function.hpp"

namespace triptych::scene {

// The content hash of a table that was read from a file, because a file of the same name may have
// other content on another day. Empty for a preset, which its name describes completely.
[[nodiscard]] std::string file_table_hash(const TransferFunction& function);

}  // namespace triptych::scene
