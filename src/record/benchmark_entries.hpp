#pragma once
// Google Benchmark's own entries in the form in which a record stores them. Every configuration has
// about eighteen entries (each frame, the aggregates, the loop), which all repeat its name and its
// counters, so only the differences are stored.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace triptych::record {

// {"merge_patches": […]}: the first entry, followed for each further entry by the merge patch (RFC
// 7396) that converts the previous entry to it. `entries` is an array of flat objects without
// nulls. The result is empty if there are no entries.
[[nodiscard]] std::string pack_benchmark_entries(const nlohmann::json& entries);

// The inverse: returns the array of entries. It also reads the text of older stores, which is one
// entry or an array of entries; an empty text gives no entries. Throws nlohmann's exceptions if the
// text is not JSON.
[[nodiscard]] nlohmann::json unpack_benchmark_entries(std::string_view text);

}  // namespace triptych::record
