#pragma once
// The command that draws what a column of the window shows.

#include <optional>
#include <string>
#include <utility>

#include "measure/request/view_request.hpp"

namespace triptych::view {

// Makes the command `triptych render …` for a configuration, given by its key. With `pixel`, the
// command explains that pixel instead of comparing the image with the reference image.
[[nodiscard]] std::string render_command(const measure::ViewRequest& request,
                                         const measure::ViewSide& side, const std::string& key,
                                         std::optional<std::pair<int, int>> pixel = std::nullopt);

}  // namespace triptych::view
