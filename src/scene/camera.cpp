#include "scene/camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "core/random.hpp"
#include "scene/exact_math.hpp"
#include "scene/free_view.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene {
namespace {

using glm::dvec3;

constexpr std::array<std::string_view, 16> paths{
    "orbit_x",      "orbit_y",       "orbit_z",       "orbit_-x",      "orbit_-y", "orbit_-z",
    "diagonal_xyz", "diagonal_-xyz", "diagonal_x-yz", "diagonal_xy-z", "path_x",   "path_y",
    "path_z",       "path_sin_x",    "path_sin_y",    "path_sin_z"};

// The bounding box of the scene, and the quantities derived from it that define all camera paths.
struct Stage {
  dvec3 centre;
  dvec3 size;
  double largest = 0;
  double tangent = 0;   // the tangent of half the field of view
  double distance = 0;  // the distance at which the largest extent exactly fills the view

  Stage(const Box& box, double fov_y_deg)
      : centre(0.5 * (box.lo + box.hi)),
        size(box.hi - box.lo),
        largest(std::max({size.x, size.y, size.z})),
        tangent(tangent_of_half(fov_y_deg)),
        distance(0.5 * largest / tangent) {}
};

struct Pose {
  dvec3 eye;
  dvec3 forward;
  dvec3 up;
};

dvec3 unit(const dvec3& v) {
  return v / std::sqrt(glm::dot(v, v));
}

// Returns the unit vector orthogonal to `forward` that is closest to +y. If `forward` is (nearly)
// parallel to y, returns the vector that is closest to −z for a camera that looks down, or to +z
// for a camera that looks up. A camera on orbit_x has the same up vector when it looks in that
// direction.
dvec3 upright(const dvec3& forward) {
  const bool steep = std::abs(forward.y) > 0.999;
  const dvec3 preferred = steep ? dvec3(0, 0, forward.y < 0 ? -1 : 1) : dvec3(0, 1, 0);
  return unit(preferred - glm::dot(preferred, forward) * forward);
}

Pose orbit(const Stage& stage, char axis, double turns) {
  const double radius = 0.5 * stage.largest + stage.distance;
  const double s = sine_turns(turns);
  const double c = cosine_turns(turns);
  dvec3 outward;
  dvec3 up;
  switch (axis) {
    case 'x':
      outward = {0, s, c};
      up = {0, c, -s};
      break;
    case 'y':
      outward = {s, 0, c};
      up = {0, 1, 0};
      break;
    default:
      outward = {c, s, 0};
      up = {-s, c, 0};
      break;
  }
  return {stage.centre + radius * outward, -outward, up};
}

Pose free_pose(const Stage& stage, const FreeView& view) {
  const double across = sine_turns(view.azimuth_deg / 360);
  const double ahead = cosine_turns(view.azimuth_deg / 360);
  const double rise = sine_turns(view.elevation_deg / 360);
  const double level = cosine_turns(view.elevation_deg / 360);
  const double radius = view.distance * (0.5 * stage.largest + stage.distance);
  const dvec3 outward(level * across, rise, level * ahead);
  return {stage.centre + radius * outward, -outward, {-rise * across, level, -rise * ahead}};
}

Pose diagonal(const Stage& stage, const dvec3& signs, double lambda) {
  const dvec3 along = stage.size * signs;
  const double length = std::sqrt(glm::dot(along, along));
  const dvec3 forward = along / length;
  const double start = 0.5 * length + stage.distance;
  return {stage.centre - (1 - lambda) * start * forward, forward, upright(forward)};
}

Pose straight(const Stage& stage, glm::length_t axis, double lambda) {
  dvec3 outward(0);
  outward[axis] = 1;
  const double start = 0.5 * stage.size[axis] + stage.distance;
  return {stage.centre + (1 - lambda) * start * outward, -outward, upright(-outward)};
}

Pose sinuous(const Stage& stage, glm::length_t axis, double lambda) {
  Pose pose = straight(stage, axis, lambda);
  const glm::length_t lateral = axis == 0 ? 2 : 0;
  pose.eye[lateral] += 0.25 * stage.size[lateral] * sine_turns(lambda);
  return pose;
}

dvec3 random_direction(core::Random& random) {
  const double z = random.uniform(-1, 1);
  const double turns = random.uniform();
  const double rho = std::sqrt(1 - z * z);
  return {rho * cosine_turns(turns), rho * sine_turns(turns), z};
}

Pose random_pose(const Stage& stage, core::Random& random) {
  Pose pose;
  pose.forward = random_direction(random);
  const double roll = random.uniform();
  const double distance = random.uniform(0.3, 1.2) * (0.5 * stage.largest + stage.distance);
  dvec3 target;
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    target[axis] = stage.centre[axis] + stage.size[axis] * random.uniform(-0.25, 0.25);
  }
  pose.eye = target - distance * pose.forward;
  const dvec3 level = upright(pose.forward);
  const dvec3 side = glm::cross(pose.forward, level);
  pose.up = unit(cosine_turns(roll) * level + sine_turns(roll) * side);
  return pose;
}

// Divides the box into 8×8×8 cells, and returns the fraction of their centres that lie inside the
// view of a camera with this pose and a square image.
double coverage(const Stage& stage, const Pose& pose) {
  constexpr int cells = 8;
  const dvec3 right = glm::cross(pose.forward, pose.up);
  int seen = 0;
  for (int cell = 0; cell < cells * cells * cells; ++cell) {
    const dvec3 place(cell % cells + 0.5, cell / cells % cells + 0.5, cell / (cells * cells) + 0.5);
    const dvec3 from_eye = stage.centre + stage.size * (place / double{cells} - 0.5) - pose.eye;
    const double reach = glm::dot(from_eye, pose.forward) * stage.tangent;
    if (reach > 0 && std::abs(glm::dot(from_eye, right)) <= reach &&
        std::abs(glm::dot(from_eye, pose.up)) <= reach) {
      ++seen;
    }
  }
  return seen / double{cells * cells * cells};
}

Pose random_view(const Stage& stage, std::uint64_t seed) {
  // For any box, this loop needs only a few iterations. The distance of a random camera from its
  // target is between 0.3 and 1.2 times the radius of the orbits, and a camera that is farther away
  // than this radius sees most of the box.
  core::Random random(seed);
  Pose pose = random_pose(stage, random);
  while (coverage(stage, pose) < random_view_coverage) pose = random_pose(stage, random);
  return pose;
}

[[noreturn]] void reject(std::string_view spec, const std::string& expected) {
  throw core::InputError(fmt::format("camera '{}': expected {}", spec, expected));
}

// Parses "i/n", and returns λ = i/n.
double parse_lambda(std::string_view spec, std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) reject(spec, "PATH:i/n");
  const auto i = parse_number<std::int32_t>(text.substr(0, slash));
  const auto n = parse_number<std::int32_t>(text.substr(slash + 1));
  if (!i || !n || *i < 0 || *i >= *n) {
    reject(spec, "PATH:i/n, where i and n are whole numbers with 0 <= i < n");
  }
  return static_cast<double>(*i) / *n;
}

Pose on_path(const Stage& stage, std::string_view path, double lambda) {
  const auto axis = static_cast<glm::length_t>(path.back() - 'x');
  if (path.starts_with("orbit_")) {
    return orbit(stage, path.back(), path.find('-') == std::string_view::npos ? lambda : -lambda);
  }
  if (path.starts_with("path_sin_")) return sinuous(stage, axis, lambda);
  if (path.starts_with("path_")) return straight(stage, axis, lambda);
  dvec3 signs(1);
  const std::size_t minus = path.find('-');
  if (minus != std::string_view::npos) {
    signs[static_cast<glm::length_t>(path[minus + 1] - 'x')] = -1;
  }
  return diagonal(stage, signs, lambda);
}

Pose pose_of(std::string_view spec, const Stage& stage) {
  const std::size_t colon = spec.find(':');
  if (colon == std::string_view::npos)
    reject(spec, "PATH:i/n, random:SEED or view:AZIMUTH/ELEVATION/DISTANCE");
  const std::string_view path = spec.substr(0, colon);
  const std::string_view rest = spec.substr(colon + 1);
  if (path == "random") {
    const auto seed = parse_number<std::uint64_t>(rest);
    if (!seed) reject(spec, "random:SEED, where SEED is an unsigned 64-bit integer");
    return random_view(stage, *seed);
  }
  if (path == "view") {
    const auto view = parse_free_view(rest);
    if (!view) {
      reject(spec,
             fmt::format("view:AZIMUTH/ELEVATION/DISTANCE with an azimuth of at most ±360 "
                         "degrees, an elevation of at most ±{} degrees and a distance from {} to "
                         "{}",
                         FreeView::steepest_deg, FreeView::nearest, FreeView::farthest));
    }
    return free_pose(stage, *view);
  }
  if (std::find(paths.begin(), paths.end(), path) == paths.end()) {
    std::string known = "random, view";
    for (const std::string_view name : paths) known += fmt::format(", {}", name);
    reject(spec, "one of the paths " + known);
  }
  return on_path(stage, path, parse_lambda(spec, rest));
}

// Sets the near and far planes to the range of the corners' depths, widened by one per cent. The
// near plane is at least a thousandth of the box's diagonal away from the eye.
void set_depth_range(Camera& camera, const Box& box) {
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -nearest;
  for (int corner = 0; corner < 8; ++corner) {
    const dvec3 place((corner & 1) != 0 ? box.hi.x : box.lo.x,
                      (corner & 2) != 0 ? box.hi.y : box.lo.y,
                      (corner & 4) != 0 ? box.hi.z : box.lo.z);
    const double depth = glm::dot(place - camera.eye, camera.forward);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  const dvec3 size = box.hi - box.lo;
  camera.near = std::max(0.99 * nearest, 1e-3 * std::sqrt(glm::dot(size, size)));
  camera.far = std::max(1.01 * farthest, 2 * camera.near);
}

void require_usable(const Box& box, double fov_y_deg) {
  if (!(fov_y_deg > 0 && fov_y_deg < 180)) {
    throw core::InputError(fmt::format(
        "the field of view is {} degrees; expected an angle between 0 and 180 degrees", fov_y_deg));
  }
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    const double extent = box.hi[axis] - box.lo[axis];
    if (!(extent > 0 && std::isfinite(extent))) {
      throw core::InputError(
          fmt::format("the data have an extent of {} along the {} axis; placing a camera requires "
                      "a positive, finite extent",
                      extent, "xyz"[axis]));
    }
  }
}

}  // namespace

double tangent_of_half(double fov_y_deg) {
  const double turns = fov_y_deg / 720;
  return sine_turns(turns) / cosine_turns(turns);
}

Camera camera_looking_at(const dvec3& eye, const dvec3& target, double fov_y_deg) {
  Camera camera;
  camera.eye = eye;
  camera.forward = glm::normalize(target - eye);
  const dvec3 right = glm::normalize(glm::cross(camera.forward, dvec3{0, 1, 0}));
  camera.up = glm::cross(right, camera.forward);
  camera.fov_y_deg = fov_y_deg;
  return camera;
}

dvec3 Camera::right() const {
  return glm::cross(forward, up);
}

dvec3 Camera::ray_direction(int x, int y, int width, int height) const {
  const double tangent = tangent_of_half(fov_y_deg);
  const double aspect = static_cast<double>(width) / height;
  const double across = (2 * (x + 0.5) / width - 1) * aspect * tangent;
  const double upwards = (1 - 2 * (y + 0.5) / height) * tangent;
  return unit(forward + across * right() + upwards * up);
}

Camera camera_at(std::string_view spec, const Box& box, double fov_y_deg) {
  require_usable(box, fov_y_deg);
  const Pose pose = pose_of(spec, Stage(box, fov_y_deg));
  Camera camera;
  // Adding zero turns -0 into +0.
  camera.eye = pose.eye + 0.0;
  camera.forward = pose.forward + 0.0;
  camera.up = pose.up + 0.0;
  camera.fov_y_deg = fov_y_deg;
  set_depth_range(camera, box);
  return camera;
}

std::array<std::string_view, 16> camera_paths() {
  return paths;
}

}  // namespace triptych::scene
