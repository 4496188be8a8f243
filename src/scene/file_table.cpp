#include "scene/file_table.hpp"

#include <algorithm>
#include <span>

#include "core/hash.hpp"

namespace triptych::scene {

std::string file_table_hash(const TransferFunction& function) {
  const auto presets = transfer_function_presets();
  if (std::ranges::find(presets, function.name) != presets.end()) return {};
  return core::content_hash(std::as_bytes(std::span(function.entries)));
}

}  // namespace triptych::scene
