#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string_view>

#include "scene/camera.hpp"
#include "scene/transfer_function.hpp"
#include "scene/volume.hpp"

namespace triptych::scene {

// Shading with the light at the eye. With the unit gradient n and the ray direction d, a sample of
// colour c contributes the colour
//   c' = c·(ambient + diffuse·|n·d|) + specular·|n·d|^exponent,
// where n·d is replaced by (g·d)/max(|g|, gradient_floor). g is the gradient of the normalised
// value per smallest spacing, computed from central differences of one voxel to either side. The
// floor keeps the shading continuous where the field is flat.
struct Shading {
  bool enabled = false;
  double ambient = 0.3;
  double diffuse = 0.7;
  double specular = 0.2;
  int exponent = 16;  // a power of two
  double gradient_floor = 1.0 / 256;
};

// The rule that integrates the light over one step of the ray.
//   - midpoint: the sample in the middle of a whole step represents the step.
//   - preintegrated: the field is assumed to be linear between its values at the front and at the
//     back of the step. Emission and absorption of the transfer function are integrated exactly
//     along that line, including the light that is absorbed within the step. The last step
//     ends where the ray leaves the box. Shading uses the gradient in the middle of the step.
//   - cells: a fourth-order rule. The ray is split at the planes through voxel centres, so that
//     the field is a cubic polynomial between two planes. Each such segment is split into ⌈1/step⌉
//     equal parts, and these are split again where the value passes a kink of the transfer function
//     (kinks.hpp). On each piece, the two-point Gauss rule computes the optical depth. The colour
//     is assumed to change linearly with the optical depth, through the colours at the two Gauss
//     points. Shading uses the gradients at these points. An opacity of 1 counts as an extinction
//     of 8192·ln 2 per voxel length.
enum class Quadrature : std::uint8_t { midpoint, preintegrated, cells };
[[nodiscard]] std::string_view name_of(Quadrature quadrature);
[[nodiscard]] Quadrature quadrature(std::string_view name);  // throws InputError

// Everything that determines the image, independent of the technique that draws it. The ray enters
// the box at t₀ and leaves it at t₁. Samples are at t₀ + (i+½)·h, where h = step_voxels · smallest
// spacing. Sample i represents the length min(h, t₁ − t₀ − i·h), so only the last sample is
// partial.
struct VolumeScene {
  std::shared_ptr<const VoxelGrid> grid;
  TransferFunction transfer_function;
  Camera camera;
  int width = 0;
  int height = 0;
  double step_voxels = 1;
  Quadrature quadrature = Quadrature::midpoint;
  Shading shading;
  std::array<float, 4> background{0, 0, 0, 0};  // premultiplied

  [[nodiscard]] Box box() const;
  [[nodiscard]] double smallest_spacing() const;
  [[nodiscard]] double step_world() const { return step_voxels * smallest_spacing(); }
  // Returns the number of parts into which Quadrature::cells splits each segment of the ray between
  // two planes of voxel centres.
  [[nodiscard]] int parts_of_cell() const;
};

[[nodiscard]] Box bounding_box(const VoxelGrid& grid);

}  // namespace triptych::scene
