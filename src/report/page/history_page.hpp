#pragma once
// Shows how cost and time changed over stores, as one self-contained page.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace triptych::report {

// Made from what comparison::to_json says about a history.
[[nodiscard]] std::string history_page(const nlohmann::json& history);

}  // namespace triptych::report
