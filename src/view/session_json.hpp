#pragma once
// The content of a session as JSON, for `triptych view --json`.

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "view/session.hpp"

namespace triptych::view {

// `images` contains for each column the position of its image in the window: x, y, width and height
// in pixels.
[[nodiscard]] nlohmann::json session_json(const Session& session,
                                          const std::vector<std::array<int, 4>>& images);

}  // namespace triptych::view
