#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string_view>

#include "scene/camera.hpp"
#include "scene/transfer_function.hpp"
#include "scene/volume.hpp"

namespace triptych::scene {

// Headlight shading: the light stands in the eye, so with n the unit gradient and d the ray
// direction
//   c' = c·(ambient + diffuse·|n·d|) + specular·|n·d|^exponent
// where n·d is replaced by (g·d)/max(|g|, gradient_floor): g is the gradient of the normalised
// value per smallest spacing, from central differences one voxel to either side. The floor keeps
// the shading continuous where the field is flat.
struct Shading {
  bool enabled = false;
  double ambient = 0.3;
  double diffuse = 0.7;
  double specular = 0.2;
  int exponent = 16;  // a power of two
  double gradient_floor = 1.0 / 256;
};

// The rule for the ray integral over one step of the lattice.
//   midpoint: the sample in the middle of a whole step stands for it.
//   preintegrated: the field is taken to run straight from its value at the step's front to that at
//     its back, and the transfer function, with the light that is lost within the step, is
//     integrated exactly along that line. The last step ends where the ray leaves the box. Shading
//     takes the gradient in the middle of the step.
//   cells: of fourth order. The ray is cut at the planes of voxel centres, between which the field
//     is a cubic; each cell's way into ⌈1/step⌉ equal parts; those where the value passes a kink of
//     the transfer function (kinks.hpp). On each piece Gauss's rule with two points gives the
//     depth, and the colour runs straight from point to point in the share of the depth. Shading
//     takes the gradient at the points. An opacity of 1 counts as an extinction of 8192·ln 2 per
//     voxel.
enum class Quadrature : std::uint8_t { midpoint, preintegrated, cells };
[[nodiscard]] std::string_view name_of(Quadrature quadrature);
[[nodiscard]] Quadrature quadrature(std::string_view name);  // throws InputError

// Everything that decides the picture, and nothing about how it is computed.
// Samples stand at t₀ + (i+½)·h, h = step_voxels · smallest spacing, t₀ where the ray enters the
// box; the i-th stands for the length min(h, t₁ − t₀ − i·h), so that only the last one is partial.
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
  // Of Quadrature::cells: into how many parts a cell's way is cut.
  [[nodiscard]] int parts_of_cell() const;
};

[[nodiscard]] Box bounding_box(const VoxelGrid& grid);

}  // namespace triptych::scene
