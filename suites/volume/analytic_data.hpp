#pragma once
// Data whose exact image is known as a closed-form solution: "analytic:PROBLEM:SIZE", a cube of
// SIZE³ voxels with its own transfer function (reference/analytic_scenes.hpp).

#include <optional>
#include <string_view>

#include "core/image.hpp"
#include "reference/analytic_scenes.hpp"
#include "scene/volume.hpp"
#include "scene/volume_scene.hpp"

namespace triptych::volume_suite {

struct AnalyticData {
  reference::AnalyticProblem problem{};
  int size = 0;
};

// The level that selects the data's own transfer function. Only analytic problems and stress cases
// have their own transfer function. For all other data, this level means `surfaces`, which makes
// rays end early.
inline constexpr std::string_view own_transfer_function = "own";

// Returns nullopt if `data` does not name an analytic problem. Throws InputError if the problem is
// unknown, if the size is outside 2…512, or if the problem is v6_layers and the size is odd.
[[nodiscard]] std::optional<AnalyticData> analytic_data(std::string_view data);

[[nodiscard]] scene::Volume analytic_volume(const AnalyticData& data);
[[nodiscard]] scene::TransferFunction analytic_transfer_function(const AnalyticData& data);

// Returns the exact image of the problem, seen from the scene's camera, in its viewport and over
// its background.
[[nodiscard]] core::Image analytic_image(const AnalyticData& data, const scene::VolumeScene& scene);

}  // namespace triptych::volume_suite
