#pragma once
// Shows how cost and time changed over stores, as one self-contained page.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace triptych::report {

// `history` is what exports/comparison_json.hpp makes of a history.
[[nodiscard]] std::string history_page(const nlohmann::json& history);

}  // namespace triptych::report
