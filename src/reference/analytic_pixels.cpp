#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "reference/analytic_setting.hpp"
#include "reference/closed_forms.hpp"

namespace triptych::reference {
namespace {

constexpr double float_rounding = 0x1.0p-24;

struct Chord {
  glm::dvec3 direction{};
  double begin = 0;
  double end = 0;
  [[nodiscard]] double length() const { return end - begin; }
};

// Clips the ray of pixel (x, y) against one plane after the other. The algorithm deliberately
// differs from the one with which the reference renderer clips rays (ray.cpp), because the two are
// checked against each other.
Chord chord_of(const Setting& setting, int x, int y) {
  Chord chord;
  chord.direction =
      setting.camera.ray_direction(x, y, setting.options.width, setting.options.height);
  chord.end = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      // A point with the coordinate p along this axis is inside if side·(p − face) ≤ 0.
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
    const double foreground = i < 3 ? channels[i].colour : opacity;
    pixel.rgba[i] =
        foreground + (1.0 - opacity) * static_cast<double>(setting.options.background[i]);
  }
  pixel.model_error = model_error;
  return pixel;
}

// Returns the error of the image that is caused by the table of the transfer function alone
// (derived in analytic_scenes.hpp).
double table_error(const Setting& setting, double length) {
  const Medium& medium = setting.medium;
  const double u = setting.voxel;
  const double left = std::exp(-u * medium.largest);
  const double slope = u * medium.slope;
  const double bend = u * medium.curvature + slope * slope;
  const double alpha = bend / (8.0 * 255.0 * 255.0) + float_rounding * (1.0 - left + slope);
  return length * alpha / (u * left) + 2.0 * float_rounding;
}

// Returns the distances along the ray at which z crosses one of the planes, and both ends of the
// ray, in ascending order.
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

// Returns the value g at height z, for the problems that vary only along z. It is constant in the
// outermost half voxels.
double height(const Setting& setting, double z) {
  const double half = 0.5 * setting.layer_z;
  return std::clamp(z, half, setting.extent.z - half) / setting.extent.z;
}

double z_at(const Setting& setting, const Chord& chord, double t) {
  return setting.camera.eye.z + t * chord.direction.z;
}

// Returns the values of z at which the field or the table's representation of the medium has a
// kink.
std::vector<double> kinks(const Setting& setting) {
  std::vector<double> at{0.5 * setting.layer_z, setting.extent.z - 0.5 * setting.layer_z};
  for (const double g : setting.medium.kinks) at.push_back(g * setting.extent.z);
  return at;
}

using Piece = std::function<Radiance(const Setting&, double g0, double g1, double length,
                                     std::size_t channel)>;

// Composites the closed-form solutions of all pieces between kinks of the field.
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

// Returns ∫ |error of g| ds along the ray, where s is the distance along the ray. The value of
// v4_gaussian at distance r from the centre is g = e^(−r²/(2σ²)), and σ is blob_sigma(). The error
// is caused by trilinear interpolation and, near the faces, by clamping. At each point of the ray,
// the derivatives of g are replaced by bounds that hold within one cell diagonal of the point. They
// are
//   |∂ᵢg| = rᵢ·g/σ²   and   |∂ᵢ²g| ≤ (1 + rᵢ²/σ²)·g/σ²,
// where rᵢ is the distance from the centre along axis i.
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

// Returns the distances at which the ray crosses the planes of the outermost voxel centres, and
// both ends of the ray, in ascending order.
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

// The point of the ray that is nearest to the box's centre, and its distance from the centre.
struct Closest {
  double along;
  double distance;
};
Closest closest_to_centre(const Setting& setting, const Chord& chord) {
  const glm::dvec3 to_centre = 0.5 * setting.extent - setting.camera.eye;
  const double along = glm::dot(to_centre, chord.direction);
  return {along, glm::length(to_centre - along * chord.direction)};
}

// Returns the light of a medium with a single colour. It depends only on the optical depth, which
// is tau times length.
std::array<Radiance, 3> single_colour_radiance(const Setting& setting, double tau, double length) {
  std::array<Radiance, 3> channels;
  for (std::size_t i = 0; i < 3; ++i) {
    channels[i] = v1_constant(tau, setting.medium.colour(0.5)[i], length);
  }
  return channels;
}

// Returns the length of the part of the ray that is within this radius of the centre.
double length_within(const Chord& chord, const Closest& closest, double radius) {
  if (!(radius > closest.distance)) return 0;
  const double half = std::sqrt((radius - closest.distance) * (radius + closest.distance));
  return std::max(
      0.0, std::min(chord.end, closest.along + half) - std::max(chord.begin, closest.along - half));
}

// Returns w, half the width of the zone around a face of the shell in which grid and table may
// differ from the closed-form solution. `face` is the radius of the face. The table changes from
// one entry to the next within h ≈ R/510 on each side of the face, where R is Shell::reach. The
// grid stores the distance r from the centre. When it is interpolated, its error is at most
// D/(r − d), plus rounding. Here, d is the diagonal of a cell, and D = Σ Δᵢ²/8 because
// |∂ᵢ²r| ≤ 1/r, with Δᵢ the spacing along axis i. In the zone, r is at least face − w, so w must be
// h + D/(face − w − d). With s = face − d, this is the smaller root of (w − h)(s − w) = D. The
// result is infinite if there is no root, which means that the grid is too coarse.
double uncertain_zone(const Setting& setting, double face) {
  const auto& spacing = setting.options.spacing;
  double squares = 0;
  for (const double delta : spacing) squares += delta * delta;
  const double s = face - std::sqrt(squares);
  const double h = shell_of(setting).reach * (1.0 / 510.0 + 2.0 * float_rounding);
  const double discriminant = (s - h) * (s - h) - squares / 2.0;
  if (!(s > h) || !(discriminant >= 0)) return std::numeric_limits<double>::infinity();
  return 0.5 * (s + h - std::sqrt(discriminant));
}

}  // namespace

double blob_sigma(const Setting& setting) {
  return std::min({setting.extent.x, setting.extent.y, setting.extent.z}) / 10.0;
}

double heights_product(const Setting& setting, const glm::dvec3& p) {
  double g = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = 0.5 * setting.options.spacing[static_cast<std::size_t>(axis)];
    g *= std::clamp(p[axis], half, setting.extent[axis] - half) / setting.extent[axis];
  }
  return g;
}

Shell shell_of(const Setting& setting) {
  const double reach = 0.5 * std::min({setting.extent.x, setting.extent.y, setting.extent.z});
  return {.reach = reach, .inner = 127.5 / 255.0 * reach, .outer = 216.5 / 255.0 * reach};
}

Wave wave_of(const Setting& setting) {
  const double length = setting.extent.z;
  // The largest change of the stored value x = (½ + 255·g)/256 over one voxel (of the smallest
  // spacing), if the amplitude a of the wave g = a·(1 − cos(πz/L))/2 is 1.
  const double slope = 255.0 / 256.0 * 0.5 * std::numbers::pi / length * setting.voxel;
  const double amplitude = std::min(1.0, 0.9 * scene::Shading{}.gradient_floor / slope);
  return {.length = length, .amplitude = amplitude, .steepest = amplitude * slope};
}

AnalyticPixel constant_pixel(const Setting& setting, int x, int y) {
  const double length = chord_of(setting, x, y).length();
  // The opacity stored in the table as a float defines the medium, so it has no error. The colours
  // are exact in float as well.
  const double tau = -std::log1p(-static_cast<double>(static_cast<float>(
                         -std::expm1(-setting.voxel * setting.medium.largest)))) /
                     setting.voxel;
  const auto channels = single_colour_radiance(setting, tau, length);
  return finish(setting, channels, 0.0);
}

AnalyticPixel linear_pixel(const Setting& setting, int x, int y) {
  return along_z(setting, linear_piece, x, y);
}

AnalyticPixel atmosphere_pixel(const Setting& setting, int x, int y) {
  return along_z(setting, atmosphere_piece, x, y);
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

AnalyticPixel gaussian_pixel(const Setting& setting, int x, int y) {
  const Chord chord = chord_of(setting, x, y);
  const double sigma = blob_sigma(setting);
  const auto [nearest, p] = closest_to_centre(setting, chord);
  const double depth = v4_gaussian_depth(setting.medium.largest, sigma, p, chord.begin - nearest,
                                         chord.end - nearest);
  const auto channels = single_colour_radiance(setting, depth, 1.0);
  if (!(chord.length() > 0)) return finish(setting, channels, 0.0);
  const double error = table_error(setting, chord.length()) +
                       setting.medium.largest * blob_interpolation_error(setting, chord);
  return finish(setting, channels, error);
}

AnalyticPixel shell_pixel(const Setting& setting, int x, int y) {
  const Chord chord = chord_of(setting, x, y);
  const Shell shell = shell_of(setting);
  const Closest closest = closest_to_centre(setting, chord);
  const auto within = [&](double radius) { return length_within(chord, closest, radius); };
  const double length = within(shell.outer) - within(shell.inner);
  const auto channels = single_colour_radiance(setting, setting.medium.largest, length);
  if (!(chord.length() > 0)) return finish(setting, channels, 0.0);
  double uncertain = 0;
  for (const double face : {shell.inner, shell.outer}) {
    const double width = uncertain_zone(setting, face);
    uncertain += within(face + width) - within(face - width);
  }
  return finish(
      setting, channels,
      -std::expm1(-setting.medium.largest * uncertain) + table_error(setting, chord.length()));
}

// The extinction is proportional to heights_product(), which is a cubic polynomial along the ray.
// The two-point Gauss rule integrates it exactly.
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
  const auto channels = single_colour_radiance(setting, depth, 1.0);
  const double error = chord.length() > 0 ? table_error(setting, chord.length()) : 0.0;
  return finish(setting, channels, error);
}

// The shaded colour is c·(ambient + diffuse·l) + specular·lⁿ, where c is the colour of the medium,
// n is Shading::exponent, d_z the z component of the ray's direction, L the extent of the box along
// z, and
//   l = |d_z|·Wave::steepest/Shading::gradient_floor·sin(πz/L).
// The gradient is that of the continuous wave. The model error includes the effect of central
// differences.
AnalyticPixel wave_pixel(const Setting& setting, int x, int y) {
  const Chord chord = chord_of(setting, x, y);
  const Wave wave = wave_of(setting);
  const scene::Shading light;
  const double tau = setting.medium.largest;
  const double length = chord.length();
  const double k = std::numbers::pi / wave.length;
  const double phase = k * z_at(setting, chord, chord.begin);
  const double rate = k * chord.direction.z;
  const double brightest = std::abs(chord.direction.z) * wave.steepest / light.gradient_floor;
  std::array<Radiance, 3> channels = single_colour_radiance(setting, tau, length);
  const double diffuse = light.diffuse * brightest * v9_lit_wave(tau, 1, phase, rate, length);
  const double specular = light.specular * std::pow(brightest, light.exponent) *
                          v9_lit_wave(tau, light.exponent, phase, rate, length);
  for (std::size_t i = 0; i < 3; ++i) {
    channels[i].colour =
        light.ambient * channels[i].colour + diffuse * setting.medium.colour(0.5)[i] + specular;
  }
  if (!(length > 0)) return finish(setting, channels, 0.0);
  const double width = k * setting.layer_z;
  const double stored = wave.amplitude + 1.0 / 256;
  const double inside = brightest * width * width * (1.0 / 6.0 + 1.0 / 8.0) +
                        float_rounding * stored / light.gradient_floor;
  const double halves = std::min(length, setting.layer_z / std::abs(chord.direction.z));
  const double steepness = light.diffuse + light.specular * light.exponent;
  return finish(setting, channels,
                steepness * (channels[0].opacity * inside + tau * halves * brightest * width / 2) +
                    table_error(setting, length));
}

}  // namespace triptych::reference
