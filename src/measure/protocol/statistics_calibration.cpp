#include "measure/protocol/statistics_calibration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "measure/contract/not_drawn.hpp"
#include "scene/generators.hpp"
#include "scene/particles.hpp"

namespace triptych::measure {
namespace {

using Calibration = std::map<std::string, record::StatisticWorth>;

// --- the scenes ---

std::shared_ptr<const scene::ParticleSet> particles_of(std::vector<std::array<float, 4>> spheres) {
  auto set = std::make_shared<scene::ParticleSet>();
  set->name = "calibration";
  set->spheres = std::move(spheres);
  for (std::uint32_t id = 0; id < set->spheres.size(); ++id) {
    set->ids.push_back(id);
    set->rgba8.push_back(0xffffffffU);
  }
  set->hash = scene::particle_hash(*set);
  return set;
}

// Returns a work whose camera is at the origin and looks along −z. Culling is off, because not
// every API would include its compute pass in the statistics of the draw.
ParticleWork seen_from_origin(std::vector<std::array<float, 4>> spheres, int width, int height,
                              double fov_y_deg) {
  ParticleWork work;
  work.scene.particles = particles_of(std::move(spheres));
  work.scene.width = width;
  work.scene.height = height;
  work.scene.camera.fov_y_deg = fov_y_deg;
  work.scene.camera.near =
      scene::depth_scale(scene::bounding_box(*work.scene.particles), work.scene.camera.eye);
  work.options.culling = technique::Culling::none;
  return work;
}

// Returns a scene with a single sphere around the eye, whose sprite covers the whole viewport.
ParticleWork sphere_around_camera() {
  return seen_from_origin({{0, 0, 0, 1}}, 66, 50, 60);
}

constexpr int small_columns = 10;
constexpr int small_rows = 10;
constexpr std::uint64_t small_sprites = std::uint64_t{small_columns} * small_rows;

// Returns a scene with a grid of spheres. Each sphere is 5 pixels wide in the image, in a cell of 7
// × 6.2 pixels. No sprite touches another sprite or the border. The height of a cell is not a whole
// number, so that adjacent rows of spheres have different positions relative to the pixel grid.
ParticleWork many_small_spheres() {
  constexpr int width = 70;
  constexpr int height = 62;
  constexpr double fov_y_deg = 20;
  constexpr double distance = 10;
  const double pixel =
      2 * distance * std::tan(fov_y_deg / 360 * std::numbers::pi) / static_cast<double>(height);
  std::vector<std::array<float, 4>> spheres;
  for (int row = 0; row < small_rows; ++row) {
    for (int column = 0; column < small_columns; ++column) {
      const double x = (column + 0.5) / small_columns - 0.5;
      const double y = (row + 0.5) / small_rows - 0.5;
      spheres.push_back({static_cast<float>(x * width * pixel),
                         static_cast<float>(y * height * pixel), static_cast<float>(-distance),
                         static_cast<float>(2.5 * pixel)});
    }
  }
  return seen_from_origin(std::move(spheres), width, height, fov_y_deg);
}

// A technique that draws a quad for each sphere, and the values of its pipeline statistics for each
// visible quad. The two primitives of each quad that reach the clipping stage are not listed,
// because they are the same for all techniques.
struct QuadTechnique {
  std::string_view id;
  record::Counts counts;
};

// quad_instanced draws instances of a strip of four vertices, quad_screen draws points, and
// quad_tess draws patches of one vertex.
const std::array<QuadTechnique, 3>& quad_techniques() {
  static const std::array<QuadTechnique, 3> techniques{{
      {"quad_instanced",
       {{"input_assembly_vertices", 4},
        {"input_assembly_primitives", 2},
        {"vertex_invocations", 4}}},
      {"quad_screen",
       {{"input_assembly_vertices", 1},
        {"input_assembly_primitives", 1},
        {"vertex_invocations", 1},
        {"geometry_invocations", 1},
        {"geometry_primitives", 2}}},
      {"quad_tess",
       {{"input_assembly_vertices", 1},
        {"input_assembly_primitives", 1},
        {"vertex_invocations", 1},
        {"tessellation_control_patches", 1},
        {"tessellation_evaluation_invocations", 4}}},
  }};
  return techniques;
}

record::Counts counts_of(const QuadTechnique& technique, std::uint64_t sprites) {
  record::Counts counts{{"clipping_invocations", 2 * sprites},
                        {"clipping_primitives", 2 * sprites}};
  for (const auto& [name, each] : technique.counts) counts[name] = each * sprites;
  return counts;
}

std::vector<CalibrationScene> draw_scenes() {
  std::vector<CalibrationScene> scenes;
  for (const QuadTechnique& technique : quad_techniques()) {
    const ParticleWork one = sphere_around_camera();
    CalibrationScene& whole = scenes.emplace_back();
    whole.name = fmt::format("one sprite of {} over the whole view", technique.id);
    whole.expected = counts_of(technique, 1);
    whole.expected["fragment_invocations"] =
        static_cast<std::uint64_t>(one.scene.width) * static_cast<std::uint64_t>(one.scene.height);
    whole.work = {.technique = std::string(technique.id), .scene = one};

    CalibrationScene& many = scenes.emplace_back();
    many.name = fmt::format("{} small sprites of {}", small_sprites, technique.id);
    many.expected = counts_of(technique, small_sprites);
    many.counts_fragments = true;
    many.work = {.technique = std::string(technique.id), .scene = many_small_spheres()};
  }
  return scenes;
}

// Returns a scene with one compute invocation for each pixel. Width and height must be multiples of
// every work-group size that is used.
CalibrationScene compute_scene(int width, int height) {
  VolumeWork volume;
  volume.scene.grid = std::make_shared<const scene::VoxelGrid>(
      scene::encode(scene::generate_volume("uniform_box", {8, 8, 8}), scene::VoxelFormat::f32));
  volume.scene.transfer_function = scene::load_transfer_function("haze");
  volume.scene.camera = scene::camera_at("orbit_y:1/8", volume.scene.box(), 60);
  volume.scene.width = width;
  volume.scene.height = height;
  volume.options.skip = technique::Skip::none;
  const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  return {.name = fmt::format("raycast of {}×{} pixels", width, height),
          .work = {.technique = "raycast", .scene = std::move(volume)},
          .expected = {{"compute_invocations", pixels}}};
}

// --- the device's readings ---

using Readings = std::map<std::string, std::vector<CalibrationReading>>;

std::optional<std::uint64_t> find_count(const record::Counts& counts, const std::string& name) {
  const auto found = counts.find(name);
  return found == counts.end() ? std::optional<std::uint64_t>{} : found->second;
}

// Adds the readings of one scene. Adds nothing if the device reports no statistics at all. If
// Triptych's counters do not contain the number of fragments, the driver's number of fragments is
// not judged.
void read_scene(Device& device, const CalibrationScene& scene, Readings& readings) {
  const auto prepared = device.prepare(scene.work);
  const record::Counts first = prepared->frame(Purpose::statistics).counts;
  if (first.empty()) return;
  const record::Counts second = prepared->frame(Purpose::statistics).counts;
  const record::Counts counters = prepared->frame(Purpose::counters).counts;
  record::Counts expected = scene.expected;
  if (scene.counts_fragments) {
    const auto fragments = find_count(counters, "fragments");
    if (fragments.value_or(0) > 0) expected["fragment_invocations"] = *fragments;
  }
  for (const auto& [name, value] : expected) {
    readings[name].push_back({.scene = scene.name,
                              .expected = value,
                              .first = find_count(first, name),
                              .second = find_count(second, name),
                              .counters = counters});
  }
}

// --- verdicts ---

std::string text_of(const std::optional<std::uint64_t>& count) {
  return count ? fmt::format("{}", *count) : "nothing";
}

// Returns the name of Triptych's counter that equals the statistic in every scene, or an empty
// string if there is no such counter.
std::string matching_counter(const std::vector<CalibrationReading>& readings) {
  for (const auto& [name, value] : readings.front().counters) {
    const bool same = std::ranges::all_of(readings, [&](const CalibrationReading& each) {
      return find_count(each.counters, name) == each.first;
    });
    // A statistic that is always 0 does not count anything, even if one of Triptych's counters is
    // also always 0.
    const bool any = std::ranges::any_of(
        readings, [](const CalibrationReading& each) { return each.first.value_or(0) > 0; });
    if (same && any) return name;
  }
  return {};
}

double multiple(const CalibrationReading& reading) {
  return static_cast<double>(reading.first.value_or(0)) / static_cast<double>(reading.expected);
}

bool all_zero(const Readings& readings) {
  return std::ranges::all_of(readings, [](const auto& entry) {
    return std::ranges::all_of(entry.second, [](const CalibrationReading& each) {
      return each.expected > 0 && each.first.value_or(1) == 0 && each.second.value_or(1) == 0;
    });
  });
}

record::StatisticWorth differences(const std::vector<CalibrationReading>& readings) {
  std::vector<std::string> wrong;
  for (const CalibrationReading& each : readings) {
    if (each.first == each.expected) continue;
    wrong.push_back(
        fmt::format("{} instead of {} ({})", text_of(each.first), each.expected, each.scene));
  }
  return {.worth = record::Worth::differs, .detail = fmt::format("{}", fmt::join(wrong, ", "))};
}

}  // namespace

std::vector<CalibrationScene> calibration_scenes(technique::Work kind) {
  if (kind == technique::Work::draw) return draw_scenes();
  return {compute_scene(64, 64), compute_scene(192, 64)};
}

record::StatisticWorth calibration_verdict(const std::vector<CalibrationReading>& readings) {
  using record::Worth;
  const auto is_reported = [](const CalibrationReading& each) { return each.first || each.second; };
  if (std::ranges::none_of(readings, is_reported)) return {.worth = Worth::absent};
  const auto unsteady = std::ranges::find_if(
      readings, [](const CalibrationReading& each) { return each.first != each.second; });
  if (unsteady != readings.end()) {
    return {.worth = Worth::unsteady,
            .detail = fmt::format("{}, then {} ({})", text_of(unsteady->first),
                                  text_of(unsteady->second), unsteady->scene)};
  }
  if (!std::ranges::all_of(readings, is_reported)) return differences(readings);
  if (std::ranges::all_of(
          readings, [](const CalibrationReading& each) { return each.first == each.expected; })) {
    return {.worth = Worth::exact};
  }
  if (const std::string counter = matching_counter(readings); !counter.empty()) {
    return {.worth = Worth::counts, .counter = counter};
  }
  const auto [low, high] = std::ranges::minmax(readings, {}, multiple);
  if (low.first == std::uint64_t{0}) return differences(readings);
  // Compares the ratios of the reported count to the expected count in all scenes.
  // Cross-multiplication avoids rounding.
  const bool same_multiple =
      std::ranges::all_of(readings, [&first = readings.front()](const CalibrationReading& each) {
        return *each.first * first.expected == *first.first * each.expected;
      });
  if (same_multiple && readings.size() > 1) {
    return {.worth = Worth::proportional, .low = multiple(low), .high = multiple(low)};
  }
  if (multiple(low) < 1) return differences(readings);
  return {.worth = Worth::inflated,
          .low = multiple(low),
          .high = multiple(high),
          .detail = fmt::format("{}; {}", low.scene, high.scene)};
}

Calibration calibrate_statistics(Device& device, technique::Work kind,
                                 std::vector<record::DeviceFault>* faults) {
  Readings readings;
  Calibration unknown;
  for (const CalibrationScene& scene : calibration_scenes(kind)) {
    try {
      if (device.unsupported(scene.work)) continue;
      read_scene(device, scene, readings);
    } catch (const core::DeviceLost&) {
      throw;
    } catch (const core::NotSupported&) {
      continue;
    } catch (const core::Error& error) {
      const bool not_ready = dynamic_cast<const StatisticsNotReady*>(&error) != nullptr;
      if (not_ready && faults != nullptr && unknown.empty()) {
        faults->push_back({.kind = record::DeviceFaultKind::statistics_not_ready,
                           .subject = std::string(technique::name_of(kind)),
                           .detail = error.what()});
      }
      // Any other error adds no device fault: if the device caused the error, drawing the
      // configurations will reveal it.
      for (const auto& [name, value] : scene.expected) {
        unknown.emplace(name, record::StatisticWorth{
                                  .worth = record::Worth::unknown,
                                  .detail = fmt::format("{} ({})", error.what(), scene.name)});
      }
    }
    // A device that reports no statistics for the first scene (as under OpenCL) reports no
    // statistics for the remaining scenes, either.
    if (readings.empty() && unknown.empty()) break;
  }
  Calibration calibration;
  if (readings.empty()) return unknown;
  if (faults != nullptr && all_zero(readings)) {
    faults->push_back({.kind = record::DeviceFaultKind::statistics_all_zero,
                       .subject = std::string(technique::name_of(kind)),
                       .detail = fmt::format("all {} statistics were 0", readings.size())});
  }
  for (const auto& [name, each] : readings) calibration[name] = calibration_verdict(each);
  // The statistics of a scene that could not be drawn are unknown, even if other scenes contain the
  // same statistics, because these scenes alone are not sufficient for a verdict.
  for (const auto& [name, reason] : unknown) calibration[name] = reason;
  return calibration;
}

}  // namespace triptych::measure
