#pragma once
// Packs the entries of Google Benchmark's output for storage in a record. A configuration has about
// eighteen entries (one for each frame, the aggregates and the loop). All of them repeat the name
// and the counters of the configuration, so only the differences between entries are stored.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace triptych::record {

// Returns {"merge_patches": […]}. The array contains the first entry, and then, for each further
// entry, the JSON merge patch (RFC 7396) that converts the previous entry to it. `entries` is an
// array of flat objects without nulls. The result is empty if there are no entries.
[[nodiscard]] std::string pack_benchmark_entries(const nlohmann::json& entries);

// The inverse of pack_benchmark_entries(): returns the array of entries, which is empty for an
// empty text. Older stores contain one entry or an array of entries instead, which are also read.
// Throws nlohmann's exceptions if the text is not JSON.
[[nodiscard]] nlohmann::json unpack_benchmark_entries(std::string_view text);

}  // namespace triptych::record
