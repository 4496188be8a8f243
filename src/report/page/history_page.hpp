#pragma once
// A self-contained page that shows how cost and time develop over several stores.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace triptych::report {

// `history` is the JSON array that to_json() in exports/comparison_json.hpp returns.
[[nodiscard]] std::string history_page(const nlohmann::json& history);

}  // namespace triptych::report
