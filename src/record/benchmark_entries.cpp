#include "record/benchmark_entries.hpp"

#include "core/json.hpp"
#include "core/json_text.hpp"

namespace triptych::record {
namespace {

using core::Json;
constexpr const char* patches_key = "merge_patches";

// Returns the merge patch that converts `from` to `to`. It contains the new and changed values, and
// null for each removed key.
Json patch(const Json& from, const Json& to) {
  Json changes = Json::object();
  for (const auto& [key, value] : to.items()) {
    const auto before = from.find(key);
    // Also compares the types, because 1 and 1.0 are equal as numbers but are written differently.
    if (before == from.end() || before->type() != value.type() || *before != value) {
      changes[key] = value;
    }
  }
  for (const auto& [key, value] : from.items()) {
    if (!to.contains(key)) changes[key] = nullptr;
  }
  return changes;
}

}  // namespace

std::string pack_benchmark_entries(const Json& entries) {
  if (entries.empty()) return {};
  Json patches = Json::array();
  Json before = Json::object();
  for (const Json& entry : entries) {
    patches.push_back(patch(before, entry));
    before = entry;
  }
  return core::json_text(Json{{patches_key, std::move(patches)}});
}

Json unpack_benchmark_entries(std::string_view text) {
  if (text.empty()) return Json::array();
  Json kept = Json::parse(text);
  if (kept.is_array()) return kept;
  if (!kept.contains(patches_key)) return Json::array({std::move(kept)});
  Json entries = Json::array();
  Json entry = Json::object();
  for (const Json& changes : kept.at(patches_key)) {
    entry.merge_patch(changes);
    entries.push_back(entry);
  }
  return entries;
}

}  // namespace triptych::record
