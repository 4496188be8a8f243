#include "suites/volume/loaded_data.hpp"

#include <cstddef>
#include <utility>

#include "scene/data_summary.hpp"
#include "scene/empty_image.hpp"
#include "scene/value_window.hpp"
#include "scene/voxel_values.hpp"
#include "suites/volume/analytic_data.hpp"
#include "suites/volume/own_levels.hpp"

namespace triptych::volume_suite {

using measure::Configuration;

namespace {

// Returns the level of `component`, or its default if the configuration is older than this factor.
std::string component_of(const Configuration& configuration) {
  const auto found = configuration.find("component");
  return found == configuration.end() ? "0" : found->second;
}

// Sets the window of the configuration. Returns the notes about it.
std::vector<std::string> set_window(scene::Volume& volume, const Configuration& configuration) {
  const auto before = static_cast<std::ptrdiff_t>(volume.facts.notes.size());
  scene::set_window(volume, scene::parse_window(configuration.at("window")),
                    scene::mapping(configuration.at("mapping")));
  return {volume.facts.notes.begin() + before, volume.facts.notes.end()};
}

}  // namespace

scene::Volume DataLoader::read(const Configuration& configuration,
                               std::optional<StressScene>& stress) const {
  const std::string& data = configuration.at("data");
  const scene::Component component = scene::parse_component(component_of(configuration));
  if (analytic_data(data) || stress_data(data)) scene::check_component(component, 1, data);
  if (const auto known = stress_data(data)) {
    stress = stress_scene(*known);
    return std::move(stress->volume);
  }
  const auto analytic = analytic_data(data);
  return analytic ? analytic_volume(*analytic) : scene::load_volume(data, folders_, component);
}

std::string LoadedData::empty_image_note(const scene::TransferFunction& function) const {
  if (stress) return {};
  return scene::empty_image_note(
      function,
      {.lo = grid->range_lo, .hi = grid->range_hi, .mapping = grid->mapping, .used = used});
}

std::vector<std::string> DataLoader::describe(const Configuration& configuration) const {
  std::optional<StressScene> stress;
  scene::Volume volume = read(configuration, stress);
  volume.name = configuration.at("data");
  std::vector<std::string> lines = scene::summary_of(volume);
  std::vector<std::string> notes = set_window(volume, configuration);
  if (!stress) {
    const OwnLevels levels(configuration, nullptr);
    notes.push_back(
        scene::empty_image_note(levels.transfer_function(folders_), {.lo = volume.range_lo,
                                                                     .hi = volume.range_hi,
                                                                     .mapping = volume.mapping,
                                                                     .used = volume.used}));
  }
  for (const std::string& note : notes) {
    if (!note.empty()) lines.push_back("note: " + note);
  }
  return lines;
}

const LoadedData& DataLoader::load(const Configuration& configuration, const ChooseFormat& choose,
                                   const OnNote& on_note) {
  const std::string& data = configuration.at("data");
  const std::string& window = configuration.at("window");
  const std::string& mapping = configuration.at("mapping");
  const std::string component = component_of(configuration);
  if (loaded_.grid && loaded_.data == data && loaded_.window == window &&
      loaded_.mapping == mapping && loaded_.component == component &&
      choose(loaded_.native, loaded_.grid->size) == loaded_.grid->format) {
    return loaded_;
  }
  loaded_ = {};  // frees the old data before the new data is loaded
  std::optional<StressScene> stress;
  scene::Volume volume = read(configuration, stress);
  for (const std::string& note : volume.facts.notes) on_note(note);
  for (const std::string& note : set_window(volume, configuration)) on_note(note);
  const scene::VoxelFormat native = scene::lossless_format(volume);
  const scene::VoxelFormat format = choose(native, volume.size);
  const bool fits_halves = scene::fits_halves(volume);
  loaded_ = {
      .data = data,
      .window = window,
      .mapping = mapping,
      .component = component,
      .stress = std::move(stress),
      .native = native,
      .fits_halves = fits_halves,
      .used = volume.used,
      .grid = std::make_shared<const scene::VoxelGrid>(scene::encode(std::move(volume), format))};
  return loaded_;
}

}  // namespace triptych::volume_suite
