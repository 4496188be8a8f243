#pragma once
// How cost and time moved over stores, as one self-contained page.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace triptych::report {

// Of what comparison::to_json tells of a history.
[[nodiscard]] std::string history_page(const nlohmann::json& history);

}  // namespace triptych::report
