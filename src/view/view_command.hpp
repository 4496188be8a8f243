#pragma once
// The command that draws what a column of the window shows.

#include <optional>
#include <string>
#include <utility>

#include "measure/request/view_request.hpp"

namespace triptych::view {

// `triptych render …` for a configuration by its key. With `pixel`, the command explains that pixel
// instead of comparing the image with the reference.
[[nodiscard]] std::string render_command(const measure::ViewRequest& request,
                                         const measure::ViewSide& side, const std::string& key,
                                         std::optional<std::pair<int, int>> pixel = std::nullopt);

}  // namespace triptych::view
