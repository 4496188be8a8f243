#include "suites/volume/analytic_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>

#include "core/error.hpp"

namespace triptych::volume_suite {
namespace {

constexpr std::string_view prefix = "analytic:";

std::string known_problems() {
  std::string names;
  for (const reference::AnalyticProblem problem : reference::analytic_problems) {
    names += fmt::format(" {}", reference::name_of(problem));
  }
  return names;
}

reference::AnalyticScene scene_of(const AnalyticData& data) {
  reference::AnalyticOptions options;
  options.size = {data.size, data.size, data.size};
  return reference::analytic_scene(data.problem, options);
}

}  // namespace

std::optional<AnalyticData> analytic_data(std::string_view data) {
  if (!data.starts_with(prefix)) return std::nullopt;
  const std::string_view rest = data.substr(prefix.size());
  const std::size_t colon = std::min(rest.find(':'), rest.size());
  const auto problem = reference::analytic_problem(rest.substr(0, colon));
  if (!problem) {
    throw core::InputError(fmt::format(
        "'{}': expected analytic:PROBLEM:SIZE, where PROBLEM is one of{}", data, known_problems()));
  }
  const std::string_view text = rest.substr(std::min(colon + 1, rest.size()));
  int size = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), size);
  const bool odd_layers = *problem == reference::AnalyticProblem::v6_layers && size % 2 != 0;
  if (error != std::errc{} || end != text.data() + text.size() || size < 2 || size > 512 ||
      odd_layers) {
    throw core::InputError(fmt::format("'{}': expected a size from 2 to 512{}", data,
                                       odd_layers ? ", and an even size for v6_layers" : ""));
  }
  return AnalyticData{*problem, size};
}

scene::Volume analytic_volume(const AnalyticData& data) {
  // The grid contains normalised values as floats, so it can be used as a volume of floats from 0
  // to 1.
  const reference::AnalyticScene analytic = scene_of(data);
  scene::Volume volume;
  volume.name = fmt::format("{}{}:{}", prefix, reference::name_of(data.problem), data.size);
  volume.size = analytic.scene.grid->size;
  volume.type = scene::ScalarType::f32;
  volume.voxels = analytic.scene.grid->data;
  return volume;
}

scene::TransferFunction analytic_transfer_function(const AnalyticData& data) {
  return scene_of(data).scene.transfer_function;
}

core::Image analytic_image(const AnalyticData& data, const scene::VolumeScene& scene) {
  reference::AnalyticOptions options;
  options.size = {data.size, data.size, data.size};
  options.width = scene.width;
  options.height = scene.height;
  options.camera = scene.camera;
  options.background = scene.background;
  const reference::AnalyticScene analytic = reference::analytic_scene(data.problem, options);
  core::Image image(scene.width, scene.height);
  auto out = image.rgba.begin();
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      for (const double channel : analytic.exact(x, y).rgba) *out++ = static_cast<float>(channel);
    }
  }
  return image;
}

}  // namespace triptych::volume_suite
