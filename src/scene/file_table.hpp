#pragma once
#include <string>

#include "scene/transfer_function.hpp"

namespace triptych::scene {

// The content hash of a table that came from a file, which may hold another one under its name
// another day; empty for a preset, whose name says all.
[[nodiscard]] std::string file_table_hash(const TransferFunction& function);

}  // namespace triptych::scene
