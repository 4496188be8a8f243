#pragma once
// The parts of an analytic scene (analytic_scenes.hpp): what fills its box, and the closed form of
// a pixel for each kind of problem.

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "reference/analytic_scenes.hpp"

namespace triptych::reference {

using Rgb = std::array<double, 3>;
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

// σ of v4_gaussian.
[[nodiscard]] double blob_sigma(const Setting& setting);

// g of v8_trilinear: its height along every axis, each constant in the outermost half voxels.
[[nodiscard]] double heights_product(const Setting& setting, const glm::dvec3& p);

// v7_shell: g is the distance from the centre in units of `reach`, 1 beyond. The shell's faces lie
// halfway between two table entries.
struct Shell {
  double reach;
  double inner;
  double outer;
};
[[nodiscard]] Shell shell_of(const Setting& setting);

// v9_wave.
struct Wave {
  double length;     // L, half a period
  double amplitude;  // a: of g from the lowest to the highest
  double steepest;   // gradient of the stored value per smallest spacing
};
[[nodiscard]] Wave wave_of(const Setting& setting);

// Pixel (x, y) by each closed form, composited over the background.
[[nodiscard]] AnalyticPixel constant_pixel(const Setting& setting, int x, int y);
[[nodiscard]] AnalyticPixel linear_pixel(const Setting& setting, int x, int y);
[[nodiscard]] AnalyticPixel atmosphere_pixel(const Setting& setting, int x, int y);
[[nodiscard]] AnalyticPixel layers_pixel(const Setting& setting, int x, int y);
[[nodiscard]] AnalyticPixel gaussian_pixel(const Setting& setting, int x, int y);
[[nodiscard]] AnalyticPixel shell_pixel(const Setting& setting, int x, int y);
[[nodiscard]] AnalyticPixel trilinear_pixel(const Setting& setting, int x, int y);
[[nodiscard]] AnalyticPixel wave_pixel(const Setting& setting, int x, int y);

}  // namespace triptych::reference
