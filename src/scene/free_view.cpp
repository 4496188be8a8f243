#include "scene/free_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/camera.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

bool is_within(double value, double lowest, double highest) {
  return value >= lowest && value <= highest;  // false for NaN
}

// Wraps an angle to [0, 360).
double wrapped(double azimuth_deg) {
  const double rest = std::fmod(azimuth_deg, 360);
  return rest < 0 ? rest + 360 : rest;
}

double rounded(double value, double unit) {
  return std::round(value / unit) * unit;
}

// Formats an angle, rounded to a tenth of a degree, and removes a decimal of 0. The format limits
// the number of decimals, because a double cannot represent most multiples of a tenth exactly.
std::string angle(double degree) {
  std::string text = fmt::format("{:.1f}", rounded(degree, 0.1) + 0.0);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

}  // namespace

std::optional<FreeView> parse_free_view(std::string_view text) {
  std::array<double, 3> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool last = i + 1 == values.size();
    const std::size_t slash = last ? text.size() : text.find('/');
    if (slash == std::string_view::npos) return std::nullopt;
    const auto value = parse_number<double>(text.substr(0, slash));
    if (!value) return std::nullopt;
    values[i] = *value;
    text.remove_prefix(last ? slash : slash + 1);
  }
  const FreeView view{values[0], values[1], values[2]};
  constexpr double most_turns_deg = 360;
  const bool usable =
      is_within(view.azimuth_deg, -most_turns_deg, most_turns_deg) &&
      is_within(view.elevation_deg, -FreeView::steepest_deg, FreeView::steepest_deg) &&
      is_within(view.distance, FreeView::nearest, FreeView::farthest);
  return usable ? std::optional(view) : std::nullopt;
}

std::string camera_of(const FreeView& view) {
  std::string azimuth = angle(wrapped(view.azimuth_deg));
  if (azimuth == "360") azimuth = "0";
  const double elevation =
      std::clamp(view.elevation_deg, -FreeView::steepest_deg, FreeView::steepest_deg);
  const double distance = std::clamp(view.distance, FreeView::nearest, FreeView::farthest);
  const std::string away = distance < 1 ? fmt::format("{:.3g}", distance)
                                        : fmt::format("{:.7g}", rounded(distance, 0.001));
  return fmt::format("view:{}/{}/{}", azimuth, angle(elevation), away);
}

FreeView free_view_near(std::string_view camera) {
  constexpr std::string_view scheme = "view:";
  if (camera.starts_with(scheme)) {
    if (const auto view = parse_free_view(camera.substr(scheme.size()))) return *view;
  }
  constexpr double fov_deg = 60;
  const Box cube{};
  const Camera on_orbit = camera_at(camera, cube, fov_deg);
  const Camera orbit = camera_at("orbit_y:0/1", cube, fov_deg);
  const glm::dvec3 centre = 0.5 * (cube.lo + cube.hi);
  const glm::dvec3 outward = -on_orbit.forward;
  return {
      .azimuth_deg = std::atan2(outward.x, outward.z) * degrees,
      .elevation_deg = std::asin(std::clamp(outward.y, -1.0, 1.0)) * degrees,
      .distance = std::clamp(glm::length(on_orbit.eye - centre) / glm::length(orbit.eye - centre),
                             FreeView::nearest, FreeView::farthest)};
}

FreeView turned(FreeView view, double right, double down) {
  constexpr double half_turn_deg = 180;
  view.azimuth_deg = wrapped(view.azimuth_deg - half_turn_deg * right);
  view.elevation_deg = std::clamp(view.elevation_deg + half_turn_deg * down,
                                  -FreeView::steepest_deg, FreeView::steepest_deg);
  return view;
}

FreeView approached(FreeView view, double notches) {
  constexpr double scale_per_notch = 0.9;
  view.distance = std::clamp(view.distance * std::pow(scale_per_notch, notches), FreeView::nearest,
                             FreeView::farthest);
  return view;
}

}  // namespace triptych::scene
