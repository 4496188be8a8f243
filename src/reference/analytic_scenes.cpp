#include "reference/analytic_scenes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "reference/closed_forms.hpp"

namespace triptych::reference {

namespace {

using Rgb = std::array<double, 3>;
constexpr double rounding = 0x1.0p-24;

// τ and straight colour as functions of g, and how steep τ is.
struct Medium {
  std::function<double(double)> tau;
  std::function<Rgb(double)> colour;
  double largest = 0;              // of τ
  double slope = 0;                // of |dτ/dg|
  double curvature = 0;            // of |d²τ/dg²|, but for its kinks
  std::vector<double> kinks = {};  // at multiples of 1/255
};

// The box, what fills it, and the ray of a pixel in it; lengths in world units.
struct Setting {
  AnalyticOptions options;
  scene::Camera camera;
  glm::dvec3 extent{};
  double voxel = 1;    // the smallest spacing
  double layer_z = 1;  // spacing along z
  Medium medium;
};

struct Chord {
  glm::dvec3 direction{};
  double begin = 0;
  double end = 0;
  [[nodiscard]] double length() const { return end - begin; }
};

// Deliberately not the renderer's: the two check each other. Cuts the ray by one plane after the
// other.
Chord chord_of(const Setting& setting, int x, int y) {
  Chord chord;
  chord.direction =
      setting.camera.ray_direction(x, y, setting.options.width, setting.options.height);
  chord.end = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      // Inside means side·(p − face) ≤ 0.
      const double face = side < 0 ? 0.0 : setting.extent[axis];
      const double distance = side * (setting.camera.eye[axis] - face);
      const double speed = side * chord.direction[axis];
      if (speed > 0) chord.end = std::min(chord.end, -distance / speed);
      if (speed < 0) chord.begin = std::max(chord.begin, distance / -speed);
      if (speed == 0 && distance > 0) chord.end = chord.begin;
    }
  }
  chord.end = std::max(chord.end, chord.begin);
  return chord;
}

AnalyticPixel finish(const Setting& setting, const std::array<Radiance, 3>& channels,
                     double model_error) {
  AnalyticPixel pixel;
  const double opacity = channels[0].opacity;
  for (std::size_t i = 0; i < 4; ++i) {
    const double own = i < 3 ? channels[i].colour : opacity;
    pixel.rgba[i] = own + (1.0 - opacity) * static_cast<double>(setting.options.background[i]);
  }
  pixel.model_error = model_error;
  return pixel;
}

// Of the picture, from the table alone: derived in the header.
double table_error(const Setting& setting, double length) {
  const Medium& medium = setting.medium;
  const double u = setting.voxel;
  const double left = std::exp(-u * medium.largest);
  const double slope = u * medium.slope;
  const double bend = u * medium.curvature + slope * slope;
  const double alpha = bend / (8.0 * 255.0 * 255.0) + rounding * (1.0 - left + slope);
  return length * alpha / (u * left) + 2.0 * rounding;
}

// Distances along the ray at which z crosses one of the planes, with both ends, ascending.
std::vector<double> cuts(const Setting& setting, const Chord& chord,
                         const std::vector<double>& planes) {
  std::vector<double> at{chord.begin, chord.end};
  const double speed = chord.direction.z;
  for (const double plane : planes) {
    if (speed == 0.0) break;
    const double t = (plane - setting.camera.eye.z) / speed;
    if (t > chord.begin && t < chord.end) at.push_back(t);
  }
  std::sort(at.begin(), at.end());
  return at;
}

// g of the problems along z, constant in the outermost half voxels.
double height(const Setting& setting, double z) {
  const double half = 0.5 * setting.layer_z;
  return std::clamp(z, half, setting.extent.z - half) / setting.extent.z;
}

double z_at(const Setting& setting, const Chord& chord, double t) {
  return setting.camera.eye.z + t * chord.direction.z;
}

// Of the field, and of the medium as the table shows it.
std::vector<double> kinks(const Setting& setting) {
  std::vector<double> at{0.5 * setting.layer_z, setting.extent.z - 0.5 * setting.layer_z};
  for (const double g : setting.medium.kinks) at.push_back(g * setting.extent.z);
  return at;
}

using Piece = std::function<Radiance(const Setting&, double g0, double g1, double length,
                                     std::size_t channel)>;

// Composites a closed form per piece between kinks of the field.
AnalyticPixel along_z(const Setting& setting, const Piece& piece, int x, int y) {
  const Chord chord = chord_of(setting, x, y);
  const std::vector<double> at = cuts(setting, chord, kinks(setting));
  std::array<Radiance, 3> channels{};
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    if (!(at[i + 1] > at[i])) continue;
    const double g0 = height(setting, z_at(setting, chord, at[i]));
    const double g1 = height(setting, z_at(setting, chord, at[i + 1]));
    for (std::size_t channel = 0; channel < 3; ++channel) {
      channels[channel] =
          over(channels[channel], piece(setting, g0, g1, at[i + 1] - at[i], channel));
    }
  }
  const double error = chord.length() > 0 ? table_error(setting, chord.length()) : 0.0;
  return finish(setting, channels, error);
}

Radiance linear_piece(const Setting& setting, double g0, double g1, double length,
                      std::size_t channel) {
  const Medium& medium = setting.medium;
  const double tau = medium.tau(g0);
  const double colour = medium.colour(g0)[channel];
  return v3_segment({tau, (medium.tau(g1) - tau) / length, colour,
                     (medium.colour(g1)[channel] - colour) / length, length});
}

Radiance atmosphere_piece(const Setting& setting, double g0, double g1, double length,
                          std::size_t channel) {
  const double colour = setting.medium.colour(g0)[channel];
  if (g0 == g1) return v1_constant(setting.medium.tau(g0), colour, length);
  const double scale_height = setting.extent.z / 2.0;
  const double z0 = g0 * setting.extent.z;
  const double z1 = g1 * setting.extent.z;
  const double depth = v5_atmosphere_depth(setting.medium.tau(0.0), scale_height, z0, z1,
                                           std::abs(z1 - z0) / length);
  return v1_constant(depth, colour, 1.0);
}

AnalyticPixel constant_pixel(const Setting& setting, int x, int y) {
  const double length = chord_of(setting, x, y).length();
  // The table's float is taken as the truth, so only the colour's own rounding would be left; it is
  // exact in float too.
  const double tau = -std::log1p(-static_cast<double>(static_cast<float>(
                         -std::expm1(-setting.voxel * setting.medium.largest)))) /
                     setting.voxel;
  std::array<Radiance, 3> channels;
  for (std::size_t i = 0; i < 3; ++i) {
    channels[i] = v1_constant(tau, setting.medium.colour(0.5)[i], length);
  }
  return finish(setting, channels, 0.0);
}

AnalyticPixel layers_pixel(const Setting& setting, int x, int y) {
  const Chord chord = chord_of(setting, x, y);
  const std::vector<double> at = cuts(setting, chord, {0.5 * setting.extent.z});
  std::array<Radiance, 3> channels{};
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    const double z = z_at(setting, chord, 0.5 * (at[i] + at[i + 1]));
    const double g = z < 0.5 * setting.extent.z ? 0.0 : 1.0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      channels[channel] = over(
          channels[channel],
          v1_constant(setting.medium.tau(g), setting.medium.colour(g)[channel], at[i + 1] - at[i]));
    }
  }
  if (!(chord.length() > 0)) return finish(setting, channels, 0.0);
  const double slope = std::abs(chord.direction.z) * 255.0 / setting.layer_z;
  const double inside = slope * chord.length() > 1.0 ? 1.0 / slope : chord.length();
  const double transition = at.size() > 2 || slope * chord.length() <= 1.0
                                ? -std::expm1(-setting.medium.largest * inside)
                                : 0.0;
  return finish(setting, channels, transition + table_error(setting, chord.length()));
}

double blob_sigma(const Setting& setting) {
  return std::min({setting.extent.x, setting.extent.y, setting.extent.z}) / 10.0;
}

// ∫ |error of g| ds by trilinear interpolation and, near the faces, clamping; the derivatives are
// taken at their worst within a cell's diagonal: |∂ᵢ²g| ≤ (1 + rᵢ²/σ²)·g/σ², |∂ᵢg| = rᵢ·g/σ².
double blob_interpolation_error(const Setting& setting, const Chord& chord) {
  constexpr int intervals = 512;
  const double sigma = blob_sigma(setting);
  const glm::dvec3 spacing = {setting.options.spacing[0], setting.options.spacing[1],
                              setting.options.spacing[2]};
  const double diagonal = glm::length(spacing);
  const double ds = chord.length() / intervals;
  double sum = 0;
  for (int i = 0; i < intervals; ++i) {
    const glm::dvec3 p = setting.camera.eye + (chord.begin + (i + 0.5) * ds) * chord.direction;
    const double r = glm::length(p - 0.5 * setting.extent);
    const double nearest = std::max(r - diagonal - 0.5 * ds, 0.0) / sigma;
    const double farthest = (r + diagonal + 0.5 * ds) / sigma;
    const double g = std::exp(-0.5 * nearest * nearest);
    for (int axis = 0; axis < 3; ++axis) {
      const double width = spacing[axis] / sigma;
      sum += ds * g * width * width / 8.0 * (1.0 + farthest * farthest);
      const double to_face = std::min(p[axis], setting.extent[axis] - p[axis]);
      if (to_face < 0.5 * spacing[axis] + ds) sum += ds * g * width / 2.0 * farthest;
    }
  }
  return sum;
}

AnalyticPixel gaussian_pixel(const Setting& setting, int x, int y) {
  const Chord chord = chord_of(setting, x, y);
  const double sigma = blob_sigma(setting);
  const glm::dvec3 to_centre = 0.5 * setting.extent - setting.camera.eye;
  const double nearest = glm::dot(to_centre, chord.direction);
  const double p = glm::length(to_centre - nearest * chord.direction);
  const double depth = v4_gaussian_depth(setting.medium.largest, sigma, p, chord.begin - nearest,
                                         chord.end - nearest);
  std::array<Radiance, 3> channels;
  for (std::size_t i = 0; i < 3; ++i) {
    channels[i] = v1_constant(depth, setting.medium.colour(0.5)[i], 1.0);
  }
  if (!(chord.length() > 0)) return finish(setting, channels, 0.0);
  const double error = table_error(setting, chord.length()) +
                       setting.medium.largest * blob_interpolation_error(setting, chord);
  return finish(setting, channels, error);
}

// g of v8_trilinear: its height along every axis, each constant in the outermost half voxels.
double heights_product(const Setting& setting, const glm::dvec3& p) {
  double g = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = 0.5 * setting.options.spacing[static_cast<std::size_t>(axis)];
    g *= std::clamp(p[axis], half, setting.extent[axis] - half) / setting.extent[axis];
  }
  return g;
}

// Where the ray crosses the outermost voxel centres, with both ends, ascending.
std::vector<double> cuts_of_all_axes(const Setting& setting, const Chord& chord) {
  std::vector<double> at{chord.begin, chord.end};
  for (int axis = 0; axis < 3; ++axis) {
    const double half = 0.5 * setting.options.spacing[static_cast<std::size_t>(axis)];
    for (const double plane : {half, setting.extent[axis] - half}) {
      const double t = (plane - setting.camera.eye[axis]) / chord.direction[axis];
      if (t > chord.begin && t < chord.end) at.push_back(t);
    }
  }
  std::sort(at.begin(), at.end());
  return at;
}

// A product of three heights is a cubic along the ray, which two points of Gauss integrate exactly.
AnalyticPixel trilinear_pixel(const Setting& setting, int x, int y) {
  const Chord chord = chord_of(setting, x, y);
  const std::vector<double> at = cuts_of_all_axes(setting, chord);
  double depth = 0;
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    const double half = 0.5 * (at[i + 1] - at[i]);
    for (const double side : {-1.0, 1.0}) {
      const double t = at[i] + half + side * half / std::numbers::sqrt3;
      const glm::dvec3 p = setting.camera.eye + t * chord.direction;
      depth += half * setting.medium.tau(heights_product(setting, p));
    }
  }
  std::array<Radiance, 3> channels;
  for (std::size_t i = 0; i < 3; ++i) {
    channels[i] = v1_constant(depth, setting.medium.colour(0.5)[i], 1.0);
  }
  const double error = chord.length() > 0 ? table_error(setting, chord.length()) : 0.0;
  return finish(setting, channels, error);
}

// Optical depths of the box along z (of the blob: through its centre) are between 1 and 2.5, so
// that nothing is hidden and nothing negligible. Colours of constant media are exact in float.
Medium medium_of(AnalyticProblem problem, const Setting& setting) {
  const double depth = 1.0 / setting.extent.z;
  const auto constant = [](double) { return Rgb{0.75, 0.5, 0.25}; };
  const auto linear = [](double g) { return Rgb{g, 1.0 - g, 0.25 + 0.5 * g}; };
  Medium medium;
  switch (problem) {
    case AnalyticProblem::v1_constant:
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
      // Constant on either side of the middle: neither slope nor curvature within a layer.
      medium = {[=](double g) { return (g < 0.5 ? 1.2 : 2.0) * depth; },
                [](double g) {
                  return g < 0.5 ? Rgb{0.75, 0.25, 0.0} : Rgb{0.0, 0.5, 1.0};
                },
                2.0 * depth, 0, 0};
      break;
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

std::function<AnalyticPixel(int, int)> exact_of(AnalyticProblem problem,
                                                std::shared_ptr<const Setting> setting) {
  switch (problem) {
    case AnalyticProblem::v1_constant:
      return [setting](int x, int y) { return constant_pixel(*setting, x, y); };
    case AnalyticProblem::v4_gaussian:
      return [setting](int x, int y) { return gaussian_pixel(*setting, x, y); };
    case AnalyticProblem::v5_atmosphere:
      return [setting](int x, int y) { return along_z(*setting, atmosphere_piece, x, y); };
    case AnalyticProblem::v6_layers:
      return [setting](int x, int y) { return layers_pixel(*setting, x, y); };
    case AnalyticProblem::v8_trilinear:
      return [setting](int x, int y) { return trilinear_pixel(*setting, x, y); };
    case AnalyticProblem::v2_ramp:
    case AnalyticProblem::v3_segment:
    case AnalyticProblem::v3_plateaus:
      break;
  }
  return [setting](int x, int y) { return along_z(*setting, linear_piece, x, y); };
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
    case AnalyticProblem::v8_trilinear:
      return "v8_trilinear";
  }
  return {};
}

std::optional<AnalyticProblem> analytic_problem(std::string_view name) {
  for (const AnalyticProblem problem : analytic_problems) {
    if (name_of(problem) == name) return problem;
  }
  return std::nullopt;
}

AnalyticScene analytic_scene(AnalyticProblem problem, const AnalyticOptions& options) {
  if (*std::min_element(options.size.begin(), options.size.end()) < 1) {
    throw core::InputError("an analytic scene needs at least one voxel per axis");
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
  analytic.exact = exact_of(problem, std::move(setting));
  return analytic;
}

}  // namespace triptych::reference
