// Stress cases 51 to 54 of the catalogue in docs/accuracy.md, which test properties of the frame.

#include <cmath>
#include <numbers>
#include <string>

#include "suites/volume/stress_parts.hpp"
#include "suites/volume/stress_scenes.hpp"

namespace triptych::volume_suite {
namespace {

// Returns the field of view at which the pixels of an image with `height` rows are as large as
// those of an image with `rows` rows and a field of view of 50°.
double fov_of_rows(int height, int rows) {
  const double half = std::tan(50 * std::numbers::pi / 360);
  return std::atan(half * height / rows) * 360 / std::numbers::pi;
}

}  // namespace

// Images that are one pixel wide or high must match the middle column, row or pixel of the image
// with 17 x 13 pixels.
StressScene stress_shape(std::string_view variant) {
  constexpr int columns = 17;
  constexpr int rows = 13;
  StressScene scene = asymmetric_scene();
  scene.width = variant.starts_with("17x") ? columns : 1;
  scene.height = variant.ends_with("x13") ? rows : 1;
  scene.camera.fov_y_deg = fov_of_rows(scene.height, rows);
  if (variant != "17x13") {
    scene.expectations = {
        {"the matching part of the image with 17x13 pixels, within the sum of both error bounds",
         record::SameImage{.changed = {{"data", "stress:shape:17x13"}},
                           .at = {(columns - scene.width) / 2, (rows - scene.height) / 2},
                           .bit_identical = false}}};
  }
  return scene;
}

// The first variant is as wide as the widest image that today's devices can draw, and the second is
// one pixel wider.
StressScene stress_widest(std::string_view variant) {
  StressScene scene = asymmetric_scene();
  scene.width = variant == "16384" ? 16384 : 16385;
  scene.height = 1;
  scene.camera.fov_y_deg = fov_of_rows(1, scene.width);
  if (variant != "16384") {
    scene.expectations = {
        {"an image, or an error that names the exceeded limit", record::MayBeRefused{}}};
  }
  return scene;
}

StressScene stress_field_of_view(std::string_view variant) {
  StressScene scene = asymmetric_scene();
  if (variant == "widest") {
    // The camera is just in front of a face, so that all rays except for the middle ones run almost
    // parallel to this face.
    scene.camera = camera_looking_at({12, 11, 24.5}, {11.5, 11, 0}, 179);
    scene.function.entries[0][3] = 0.1F;
    return scene;
  }
  // The image covers only a thousandth of a voxel, in a region where the field is steep.
  scene.camera = camera_looking_at({31, 33, 41}, {9.25, 16.5, 12.75}, 0.001);
  return scene;
}

StressScene stress_asymmetric(std::string_view /*variant*/) {
  StressScene scene = asymmetric_scene();
  scene.camera = camera_looking_at({12, 14, 62}, {12, 12, 12}, 34);
  scene.width = 40;
  scene.height = 32;
  return scene;
}

}  // namespace triptych::volume_suite
