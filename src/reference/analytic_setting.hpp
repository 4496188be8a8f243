#pragma once
// The parts of an analytic scene (analytic_scenes.hpp): the medium in its box, and the closed-form
// solution of a pixel for each problem.

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "reference/analytic_scenes.hpp"

namespace triptych::reference {

using Rgb = std::array<double, 3>;
// The extinction τ (optical depth per world unit) and the colour (not premultiplied) as functions
// of the value g, which each problem computes from the position (analytic_scenes.hpp), with bounds
// on the derivatives of τ.
struct Medium {
  std::function<double(double)> tau;
  std::function<Rgb(double)> colour;
  double largest = 0;              // maximum of τ
  double slope = 0;                // maximum of |dτ/dg|
  double curvature = 0;            // maximum of |d²τ/dg²| between the kinks
  std::vector<double> kinks = {};  // positions of kinks, multiples of 1/255
};

// The box, the medium in it, and the camera. Lengths are in world units.
struct Setting {
  AnalyticOptions options;
  scene::Camera camera;
  glm::dvec3 extent{};
  double voxel = 1;    // smallest spacing
  double layer_z = 1;  // spacing along z
  Medium medium;
};

// Returns the standard deviation σ of v4_gaussian.
[[nodiscard]] double blob_sigma(const Setting& setting);

// Returns the value g of v8_trilinear at p, which is the product of the coordinates of p, each
// divided by the extent of the box along its axis. In the outermost half voxels, a coordinate is
// clamped to the nearest voxel centre.
[[nodiscard]] double heights_product(const Setting& setting, const glm::dvec3& p);

// The parameters of v7_shell. The value g is the distance from the centre in units of `reach`,
// limited to 1. The faces of the shell are halfway between two table entries.
struct Shell {
  double reach;
  double inner;
  double outer;
};
[[nodiscard]] Shell shell_of(const Setting& setting);

// The parameters of v9_wave.
struct Wave {
  double length;     // L, half a period
  double amplitude;  // a, the difference between the highest and the lowest g
  double steepest;   // largest gradient of the stored value, per smallest spacing
};
[[nodiscard]] Wave wave_of(const Setting& setting);

// Each function returns the closed-form solution of one problem for pixel (x, y), composited over
// the background.
[[nodiscard]] AnalyticPixel constant_pixel(const Setting& setting, int x, int y);
[[nodiscard]] AnalyticPixel linear_pixel(const Setting& setting, int x, int y);
[[nodiscard]] AnalyticPixel atmosphere_pixel(const Setting& setting, int x, int y);
[[nodiscard]] AnalyticPixel layers_pixel(const Setting& setting, int x, int y);
[[nodiscard]] AnalyticPixel gaussian_pixel(const Setting& setting, int x, int y);
[[nodiscard]] AnalyticPixel shell_pixel(const Setting& setting, int x, int y);
[[nodiscard]] AnalyticPixel trilinear_pixel(const Setting& setting, int x, int y);
[[nodiscard]] AnalyticPixel wave_pixel(const Setting& setting, int x, int y);

}  // namespace triptych::reference
