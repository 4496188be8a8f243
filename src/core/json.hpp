#pragma once
// The JSON type of this project. Headers that only need a declaration of the type include
// <nlohmann/json_fwd.hpp>.

#include <nlohmann/json.hpp>

namespace triptych::core {
using Json = nlohmann::json;  // keys are sorted, so equal values are printed as identical text
}
