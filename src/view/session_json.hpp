#pragma once
// Converts the content of a session to JSON, for `triptych view --json`.

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "view/session.hpp"

namespace triptych::view {

// `images` contains, for each column, the rectangle of its image in the window: x, y, width and
// height in pixels.
[[nodiscard]] nlohmann::json session_json(const Session& session,
                                          const std::vector<std::array<int, 4>>& images);

}  // namespace triptych::view
