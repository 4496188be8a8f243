#pragma once
// The truth for volumes: the emission–absorption integral on the scene's sample lattice, in double
// precision, one voxel value and one table entry at a time. Shares no code with the techniques.

#include <cstdint>
#include <vector>

#include "core/image.hpp"
#include "scene/volume_scene.hpp"

namespace triptych::reference {

// What the arithmetic of a device may do wrong; each term is derived where the suite states it
// (suites/volume/tolerance.hpp). All are worst cases per operation, carried along each ray to first
// order.
struct ErrorModel {
  double position_error_voxels = 0;  // of a sample's place, per axis
  double value_error = 0;  // of a fetched normalised value, absolute, beside filter_weight_error
  // of every voxel, relative to its normalised value, which is not below 0
  double voxel_rounding = 0;
  double filter_weight_error = 0;  // of interpolation weights: times the spread of the eight voxels
  double table_error = 0;          // of a looked-up colour or opacity, absolute
  double opacity_error = 0;        // of the step-corrected opacity, relative
  double compositing_error = 0;    // of each multiply–add into colour and transmittance, relative
                                   // and of each operation of shading
  double ert = 0;                  // ε at which a device may stop
  double adapt = 0;         // how far it may move any channel by taking samples together, absolute
  double output_error = 0;  // of a finished channel, relative: where it is stored coarser
                            // than it was computed
};

struct Truth {
  int width = 0;
  int height = 0;
  std::vector<double> rgba;   // as core::Image, premultiplied, top row first
  std::vector<double> bound;  // per pixel: the largest error of any channel that the model allows;
                              // of render_volume_converged: the change by its last halvings
  std::uint64_t samples = 0;  // of render_volume_converged: points of rays that were looked up

  [[nodiscard]] core::Image image() const;        // rounded to float
  [[nodiscard]] core::Image bound_image() const;  // the bound in all four channels, rounded up
};

// Cost: about (samples × 8 voxels), shared by `threads` threads (0: as many as there are); the
// result does not depend on their number. Throws InputError for a scene without volume, with a step
// ≤ 0 or with data that does not match its size.
[[nodiscard]] Truth render_volume(const scene::VolumeScene& scene, const ErrorModel& model = {},
                                  int threads = 0);

// The same ray integral with every step refined until halving them all changes no channel by more
// than `tolerance`: the limit of step → 0 for this grid and table. For orders of convergence.
[[nodiscard]] Truth render_volume_converged(const scene::VolumeScene& scene, double tolerance,
                                            int threads = 0);

// Version of this renderer: changes whenever its pictures may.
inline constexpr const char* volume_version = "3";
// And of its limits.
inline constexpr const char* converged_version = "3";

}  // namespace triptych::reference
