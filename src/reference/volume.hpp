#pragma once
// The reference renderer for volumes: the emission–absorption integral at the scene's sample
// positions, in double precision. It reads every voxel and every table entry individually, and
// shares no code with the techniques.

#include <cstdint>
#include <vector>

#include "core/image.hpp"
#include "reference/rows.hpp"
#include "scene/volume_scene.hpp"

namespace triptych::reference {

// The errors that the arithmetic of a device may have. The volume suite derives each term
// (suites/volume/tolerance.hpp). Each term is a worst case for one operation. The renderer
// propagates these errors along each ray.
struct ErrorModel {
  double position_error_voxels = 0;  // error of a sample's position, per axis
  // Absolute error of a normalised value, excluding filter_weight_error.
  double value_error = 0;
  // Relative error of every voxel, for normalised values, which are not negative.
  double voxel_rounding = 0;
  // Error of interpolation weights; it is multiplied by the spread of the 8 voxels.
  double filter_weight_error = 0;
  double table_error = 0;        // absolute error of a looked-up colour or opacity
  double opacity_error = 0;      // relative error of the opacity of a step
  double compositing_error = 0;  // relative error of each multiply–add into colour and
                                 // transmittance, and of each shading operation
  double ert = 0;                // transmittance below which a device may stop
  double adapt = 0;              // largest change of any channel that merging samples may cause
  double output_error = 0;       // relative error of a final channel value that is
                                 // stored with reduced precision
};

struct Truth {
  int width = 0;
  int height = 0;
  std::vector<double> rgba;   // as in core::Image, premultiplied, top row first
  std::vector<double> bound;  // per pixel: the largest error of any channel that the model allows;
                              // for render_volume_converged: the change caused by the last halvings
  // Only for render_volume_converged: the number of points on rays that were looked up.
  std::uint64_t samples = 0;

  [[nodiscard]] core::Image image() const;        // rounded to float
  [[nodiscard]] core::Image bound_image() const;  // each pixel's bound, in all channels, rounded up
};

// Renders the scene. The work, which is about eight voxel fetches per sample, is distributed over
// `threads` threads (0 means one for each hardware thread). The result does not depend on the
// number of threads. `on_rows` is called as in for_each_row(). Throws InputError if the scene has
// no volume, if the step is ≤ 0, or if the data do not match the size of the volume.
[[nodiscard]] Truth render_volume(const scene::VolumeScene& scene, const ErrorModel& model = {},
                                  int threads = 0, const OnRows& on_rows = {});

// Computes the limit of the image for step → 0, for this grid and table. Cuts each ray into pieces,
// and halves each piece until halving changes its light by no more than the piece's share of
// `tolerance`. The result is used to measure orders of convergence.
[[nodiscard]] Truth render_volume_converged(const scene::VolumeScene& scene, double tolerance,
                                            int threads = 0, const OnRows& on_rows = {});

// The version of this renderer. It changes whenever its images may change.
inline constexpr const char* volume_version = "3";
// The version of render_volume_converged.
inline constexpr const char* converged_version = "3";

}  // namespace triptych::reference
