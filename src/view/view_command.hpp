#pragma once
// Composes the command line that reproduces the content of one column of the window.

#include <optional>
#include <string>
#include <utility>

#include "measure/request/view_request.hpp"

namespace triptych::view {

// Returns the command `triptych render …` for the configuration with this key. With `pixel`, the
// command explains that pixel instead of comparing the image with the reference image.
[[nodiscard]] std::string render_command(const measure::ViewRequest& request,
                                         const measure::ViewSide& side, const std::string& key,
                                         std::optional<std::pair<int, int>> pixel = std::nullopt);

}  // namespace triptych::view
