#pragma once
// Google Benchmark's own entries as a record keeps them. There are a dozen and a half for every
// configuration – each frame, the aggregates, the loop – which repeat its name and counters.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace triptych::record {

// {"merge_patches": […]}: the first entry, then for each further one the merge patch (RFC 7396)
// that makes it of the one before. `entries`: an array of flat objects, without nulls. Without any:
// empty.
[[nodiscard]] std::string pack_benchmark_entries(const nlohmann::json& entries);

// The array again. Text of older stores, an entry or an array of them, is taken as it is; empty
// text has none. Throws nlohmann's exceptions for what is no JSON.
[[nodiscard]] nlohmann::json unpack_benchmark_entries(std::string_view text);

}  // namespace triptych::record
