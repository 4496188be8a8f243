#include "reference/analytic_scenes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "reference/analytic_setting.hpp"

namespace triptych::reference {

namespace {

// The optical depth of the box along z (for the blob: through its centre) is between 1 and 2.5, so
// that no part is hidden and no part is negligible. The colours of constant media are exact in
// float.
Medium medium_of(AnalyticProblem problem, const Setting& setting) {
  const double depth = 1.0 / setting.extent.z;
  const auto constant = [](double) { return Rgb{0.75, 0.5, 0.25}; };
  const auto linear = [](double g) { return Rgb{g, 1.0 - g, 0.25 + 0.5 * g}; };
  Medium medium;
  switch (problem) {
    case AnalyticProblem::v1_constant:
    case AnalyticProblem::v9_wave:
      medium = {[=](double) { return 1.5 * depth; }, constant, 1.5 * depth, 0, 0};
      break;
    case AnalyticProblem::v2_ramp:
      medium = {[=](double g) { return 3.0 * depth * g; }, linear, 3.0 * depth, 3.0 * depth, 0};
      break;
    case AnalyticProblem::v3_segment:
      medium = {[=](double g) { return (2.5 - 2.0 * g) * depth; }, linear, 2.5 * depth, 2.0 * depth,
                0};
      break;
    case AnalyticProblem::v3_plateaus: {
      const auto inner = [](double g) { return std::clamp((g - 0.2) / 0.6, 0.0, 1.0); };
      medium = {[=](double g) { return (2.5 - 2.0 * inner(g)) * depth; },
                [=](double g) { return linear(inner(g)); },
                2.5 * depth,
                2.0 / 0.6 * depth,
                0,
                {0.2, 0.8}};
      break;
    }
    case AnalyticProblem::v4_gaussian: {
      const double tau = 1.5 / (blob_sigma(setting) * std::sqrt(2.0 * std::numbers::pi));
      medium = {[=](double g) { return tau * g; }, constant, tau, tau, 0};
      break;
    }
    case AnalyticProblem::v5_atmosphere:
      medium = {[=](double g) { return 2.5 * depth * std::exp(-2.0 * g); }, constant, 2.5 * depth,
                5.0 * depth, 10.0 * depth};
      break;
    case AnalyticProblem::v6_layers:
      // The medium is constant on either side of the middle, so it has neither slope nor curvature
      // within a layer.
      medium = {[=](double g) { return (g < 0.5 ? 1.2 : 2.0) * depth; },
                [](double g) {
                  return g < 0.5 ? Rgb{0.75, 0.25, 0.0} : Rgb{0.0, 0.5, 1.0};
                },
                2.0 * depth, 0, 0};
      break;
    case AnalyticProblem::v7_shell: {
      const Shell shell = shell_of(setting);
      const double tau = 0.75 / (shell.outer - shell.inner);
      medium = {[=](double g) {
                  const double r = g * shell.reach;
                  return r > shell.inner && r < shell.outer ? tau : 0.0;
                },
                constant, tau, 0, 0};
      break;
    }
    case AnalyticProblem::v8_trilinear:
      medium = {[=](double g) { return 8.0 * depth * g; }, constant, 8.0 * depth, 8.0 * depth, 0};
      break;
  }
  return medium;
}

double stored_g(AnalyticProblem problem, const Setting& setting, const std::array<int, 3>& voxel) {
  const glm::dvec3 spacing{setting.options.spacing[0], setting.options.spacing[1],
                           setting.options.spacing[2]};
  const glm::dvec3 centre = (glm::dvec3(voxel[0], voxel[1], voxel[2]) + 0.5) * spacing;
  if (problem == AnalyticProblem::v1_constant) return 0.5;
  if (problem == AnalyticProblem::v6_layers) return centre.z < 0.5 * setting.extent.z ? 0.0 : 1.0;
  if (problem == AnalyticProblem::v7_shell) {
    return std::min(1.0, glm::length(centre - 0.5 * setting.extent) / shell_of(setting).reach);
  }
  if (problem == AnalyticProblem::v9_wave) {
    const Wave wave = wave_of(setting);
    return wave.amplitude * 0.5 * (1.0 - std::cos(std::numbers::pi * centre.z / wave.length));
  }
  if (problem == AnalyticProblem::v8_trilinear) return heights_product(setting, centre);
  if (problem != AnalyticProblem::v4_gaussian) return centre.z / setting.extent.z;
  const double r = glm::length(centre - 0.5 * setting.extent) / blob_sigma(setting);
  return std::exp(-0.5 * r * r);
}

std::shared_ptr<const scene::VoxelGrid> make_grid(AnalyticProblem problem, const Setting& setting) {
  scene::Volume volume;
  volume.name = "analytic:" + std::string(name_of(problem));
  volume.size = setting.options.size;
  volume.spacing = setting.options.spacing;
  volume.type = scene::ScalarType::f32;
  const std::array<int, 3> n = volume.size;
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      for (int i = 0; i < n[0]; ++i) {
        const double g = stored_g(problem, setting, {i, j, k});
        const auto bytes = std::bit_cast<std::array<std::byte, sizeof(float)>>(
            static_cast<float>((0.5 + 255.0 * g) / 256.0));
        volume.voxels.insert(volume.voxels.end(), bytes.begin(), bytes.end());
      }
    }
  }
  return std::make_shared<const scene::VoxelGrid>(
      scene::encode(std::move(volume), scene::VoxelFormat::f32));
}

scene::TransferFunction make_table(AnalyticProblem problem, const Setting& setting) {
  scene::TransferFunction function;
  function.name = name_of(problem);
  for (std::size_t k = 0; k < function.entries.size(); ++k) {
    const double g = static_cast<double>(k) / 255.0;
    const Rgb colour = setting.medium.colour(g);
    for (std::size_t i = 0; i < 3; ++i) function.entries[k][i] = static_cast<float>(colour[i]);
    function.entries[k][3] =
        static_cast<float>(-std::expm1(-setting.voxel * setting.medium.tau(g)));
  }
  return function;
}

scene::Camera outside(const glm::dvec3& extent) {
  scene::Camera camera;
  camera.eye = 0.5 * extent + 1.1 * glm::length(extent) * glm::normalize(glm::dvec3(0.45, 0.35, 1));
  camera.forward = glm::normalize(0.5 * extent - camera.eye);
  camera.up = glm::normalize(glm::cross(glm::cross(camera.forward, {0, 1, 0}), camera.forward));
  camera.fov_y_deg = 60;
  return camera;
}

using PixelOf = AnalyticPixel (*)(const Setting&, int x, int y);

PixelOf pixel_of(AnalyticProblem problem) {
  switch (problem) {
    case AnalyticProblem::v1_constant:
      return constant_pixel;
    case AnalyticProblem::v2_ramp:
    case AnalyticProblem::v3_segment:
    case AnalyticProblem::v3_plateaus:
      return linear_pixel;
    case AnalyticProblem::v4_gaussian:
      return gaussian_pixel;
    case AnalyticProblem::v5_atmosphere:
      return atmosphere_pixel;
    case AnalyticProblem::v6_layers:
      return layers_pixel;
    case AnalyticProblem::v7_shell:
      return shell_pixel;
    case AnalyticProblem::v8_trilinear:
      return trilinear_pixel;
    case AnalyticProblem::v9_wave:
      return wave_pixel;
  }
  return nullptr;
}

}  // namespace

std::string_view name_of(AnalyticProblem problem) {
  switch (problem) {
    case AnalyticProblem::v1_constant:
      return "v1_constant";
    case AnalyticProblem::v2_ramp:
      return "v2_ramp";
    case AnalyticProblem::v3_segment:
      return "v3_segment";
    case AnalyticProblem::v3_plateaus:
      return "v3_plateaus";
    case AnalyticProblem::v4_gaussian:
      return "v4_gaussian";
    case AnalyticProblem::v5_atmosphere:
      return "v5_atmosphere";
    case AnalyticProblem::v6_layers:
      return "v6_layers";
    case AnalyticProblem::v7_shell:
      return "v7_shell";
    case AnalyticProblem::v8_trilinear:
      return "v8_trilinear";
    case AnalyticProblem::v9_wave:
      return "v9_wave";
  }
  return {};
}

std::optional<AnalyticProblem> analytic_problem(std::string_view name) {
  for (const AnalyticProblem problem : analytic_problems) {
    if (name_of(problem) == name) return problem;
  }
  return std::nullopt;
}

bool is_shaded(AnalyticProblem problem) {
  return problem == AnalyticProblem::v9_wave;
}

AnalyticScene analytic_scene(AnalyticProblem problem, const AnalyticOptions& options) {
  if (*std::min_element(options.size.begin(), options.size.end()) < 1) {
    throw core::InputError("an analytic scene needs at least one voxel along each axis");
  }
  if (problem == AnalyticProblem::v6_layers && options.size[2] % 2 != 0) {
    throw core::InputError("v6_layers needs an even number of voxels along z");
  }
  auto setting = std::make_shared<Setting>();
  setting->options = options;
  setting->extent = {options.size[0] * options.spacing[0], options.size[1] * options.spacing[1],
                     options.size[2] * options.spacing[2]};
  setting->camera = options.camera.value_or(outside(setting->extent));
  setting->voxel = *std::min_element(options.spacing.begin(), options.spacing.end());
  setting->layer_z = options.spacing[2];
  setting->medium = medium_of(problem, *setting);

  AnalyticScene analytic;
  analytic.scene.grid = make_grid(problem, *setting);
  analytic.scene.transfer_function = make_table(problem, *setting);
  analytic.scene.camera = setting->camera;
  analytic.scene.width = options.width;
  analytic.scene.height = options.height;
  analytic.scene.step_voxels = options.step_voxels;
  analytic.scene.background = options.background;
  analytic.scene.shading.enabled = is_shaded(problem);
  analytic.exact = [setting = std::shared_ptr<const Setting>(std::move(setting)),
                    pixel = pixel_of(problem)](int x, int y) { return pixel(*setting, x, y); };
  return analytic;
}

}  // namespace triptych::reference
