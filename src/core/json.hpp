#pragma once
// The one spelling of JSON in this project. Headers that only name the type include
// <nlohmann/json_fwd.hpp>.

#include <nlohmann/json.hpp>

namespace triptych::core {
using Json = nlohmann::json;  // keys sorted: two equal values print the same bytes
}
