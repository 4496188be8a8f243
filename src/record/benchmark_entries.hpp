#pragma once
// Packs the entries of Google Benchmark's output for storage in a record. A configuration has about
// eighteen entries: one for each timed frame, one for each aggregate (such as the mean), and one
// for the loop that is timed as a whole. All entries of a configuration repeat its name and
// counters, so only the differences between the entries are stored.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace triptych::record {

// Returns {"merge_patches": […]}. The array contains the first entry. For each further entry, it
// contains the JSON merge patch (RFC 7396) that converts the previous entry to this entry.
// `entries` must be an array of flat objects without nulls. If it is empty, the result is an empty
// string.
[[nodiscard]] std::string pack_benchmark_entries(const nlohmann::json& entries);

// The inverse of pack_benchmark_entries(). Returns an array of entries, which is empty if `text` is
// empty. Also accepts the formats of older stores, which contain a single entry or a plain array of
// entries. Throws an exception of nlohmann::json if `text` is not JSON.
[[nodiscard]] nlohmann::json unpack_benchmark_entries(std::string_view text);

}  // namespace triptych::record
