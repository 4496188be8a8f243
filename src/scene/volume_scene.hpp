#pragma once
#include <array>
#include <cstdint>
#include <memory>

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
enum class Quadrature : std::uint8_t { midpoint, preintegrated };

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
};

[[nodiscard]] Box bounding_box(const VoxelGrid& grid);

}  // namespace triptych::scene
