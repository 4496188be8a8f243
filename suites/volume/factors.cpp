#include "suites/volume/factors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/error.hpp"
#include "scene/camera.hpp"
#include "scene/generators.hpp"
#include "scene/transfer_function.hpp"
#include "technique/catalogue.hpp"

namespace triptych::volume_suite {
namespace {

using measure::Factor;
using measure::FactorKind;

std::vector<std::string> technique_ids() {
  std::vector<std::string> ids;
  for (const technique::Technique& each : technique::catalogue()) {
    if (each.suite == "volume") ids.push_back(each.id);
  }
  return ids;
}

Factor choice(std::string name, std::vector<std::string> levels, std::string standard,
              bool of_scene, std::string summary) {
  return {.name = std::move(name),
          .kind = FactorKind::choice,
          .levels = std::move(levels),
          .standard = std::move(standard),
          .of_scene = of_scene,
          .summary = std::move(summary)};
}

Factor number(std::string name, double minimum, double maximum, std::string standard, bool of_scene,
              std::string summary) {
  return {.name = std::move(name),
          .kind = FactorKind::number,
          .levels = {},
          .minimum = minimum,
          .maximum = maximum,
          .standard = std::move(standard),
          .of_scene = of_scene,
          .summary = std::move(summary)};
}

Factor text(std::string name, std::string standard, std::string summary) {
  return {.name = std::move(name),
          .kind = FactorKind::text,
          .levels = {},
          .standard = std::move(standard),
          .of_scene = true,
          .summary = std::move(summary)};
}

void check_generator(std::string_view value) {
  const std::string_view rest = value.substr(std::string_view("generate:").size());
  const std::string_view name = rest.substr(0, rest.find(':'));
  const auto known = scene::volume_generators();
  if (std::ranges::find(known, name, &scene::GeneratorInfo::name) != known.end()) return;
  std::string names;
  for (const scene::GeneratorInfo& each : known) names += fmt::format(" {}", each.name);
  throw core::InputError(fmt::format("unknown generator '{}'; there are:{}", name, names));
}

}  // namespace

const std::vector<Factor>& volume_factors() {
  static const std::vector<Factor> factors{
      choice("technique", technique_ids(), "raycast", false, "how the picture is made"),
      text("data", "generate:mandelbulb:96",
           "a volume file (.nrrd, .nhdr, .dat) or generate:NAME:SIZE or generate:NAME:NXxNYxNZ"),
      choice("voxel", {"auto", "u8", "u16", "f32"}, "auto", false,
             "how voxels are stored on the device; auto: the device's fastest exact path"),
      choice("sampler", {"auto", "hardware", "manual"}, "auto", false,
             "who interpolates between voxels; auto: as for voxel"),
      text("transfer_function", "haze", "haze, surfaces, or a file of 256 RGBA entries"),
      number("step", 1.0 / 64, 4096, "1", true, "distance of samples in smallest voxel spacings"),
      choice("quadrature", {"midpoint"}, "midpoint", true, "rule for the ray integral"),
      choice("shading", {"none", "gradient"}, "none", true, "headlight from central differences"),
      choice("skip", {"none", "bricks"}, "bricks", false, "how empty space is skipped"),
      number("ert", 0, 0.5, "0.001953125", false,
             "transmittance below which a ray ends; 0: never. The default is half an 8-bit step"),
      text("camera", "orbit_y:1/8", "PATH:i/n (orbit_y:1/8, path_z:3/36, …) or random:SEED"),
      text("viewport", "256", "N for NxN, or WxH, in pixels"),
  };
  return factors;
}

std::array<int, 2> parse_viewport(std::string_view value) {
  const auto fail = [&]() {
    return core::InputError(
        fmt::format("viewport '{}': expected N or WxH with 1 to 16384 pixels a side", value));
  };
  const auto side = [&](std::string_view digits) {
    int n = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), n);
    if (error != std::errc{} || end != digits.data() + digits.size() || n < 1 || n > 16384)
      throw fail();
    return n;
  };
  const auto cross = value.find('x');
  if (cross == std::string_view::npos) return {side(value), side(value)};
  return {side(value.substr(0, cross)), side(value.substr(cross + 1))};
}

void check_value(const Factor& factor, std::string_view value,
                 const std::vector<std::filesystem::path>& folders) {
  if (factor.name == "viewport") {
    static_cast<void>(parse_viewport(value));
  } else if (factor.name == "camera") {
    static_cast<void>(scene::camera_at(value, scene::Box{}, field_of_view));
  } else if (factor.name == "data") {
    if (value.starts_with("generate:")) check_generator(value);
  } else if (factor.name == "transfer_function") {
    static_cast<void>(scene::load_transfer_function(value, folders));
  }
}

}  // namespace triptych::volume_suite
