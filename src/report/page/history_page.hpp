#pragma once
// Shows the development of cost and time over several stores on one self-contained page.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace triptych::report {

// `history` is the JSON form of a history from exports/comparison_json.hpp.
[[nodiscard]] std::string history_page(const nlohmann::json& history);

}  // namespace triptych::report
