#pragma once
// Compares images of volumes with reference images.

#include <cmath>

#include "reference/analytic_scenes.hpp"
#include "reference/volume.hpp"
#include "suites/volume/tolerance.hpp"
#include "under_test.hpp"

namespace triptych::contract {

// Checks that every channel of every pixel is within the error bound that is derived for the voxel
// format, the sampler and the precision of this work.
inline void expect_within_bound(measure::Device& device, const measure::Work& work) {
  const auto& volume = std::get<measure::VolumeWork>(work.scene);
  const measure::VolumePath path{volume.scene.grid->format, volume.options.sampler};
  const volume_suite::PathPrecision precision{
      .ert = volume.options.ert,
      .adapt = volume.options.adapt,
      .filter_weight_error = device.filter_weight_error(path),
      .precision = volume.options.precision};
  const reference::Truth truth =
      reference::render_volume(volume.scene, volume_suite::error_model(volume.scene, precision));
  const core::Image image = draw(device, work);
  for (std::size_t i = 0; i < truth.rgba.size(); ++i) {
    ASSERT_LE(std::abs(static_cast<double>(image.rgba[i]) - truth.rgba[i]), truth.bound[i / 4])
        << "pixel " << i / 4 % 64 << ' ' << i / 4 / 64 << " channel " << i % 4;
  }
}

// Checks that every channel of every pixel differs from the closed-form solution by no more than
// the solution's own error plus the bound of fp32, without early termination.
inline void expect_closed_form(measure::Device& device, const measure::Work& work,
                               const reference::AnalyticScene& analytic) {
  const core::Image image = draw(device, work);
  const auto model = volume_suite::error_model(analytic.scene, {});
  const core::Image bound = reference::render_volume(analytic.scene, model).bound_image();
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto exact = analytic.exact(x, y);
      for (std::size_t c = 0; c < 4; ++c) {
        ASSERT_NEAR(image.pixel(x, y)[c], exact.rgba[c],
                    exact.model_error + static_cast<double>(bound.pixel(x, y)[c]))
            << x << ' ' << y;
      }
    }
  }
}

// Returns the largest ratio of a channel's error to the bound of its pixel.
inline double share_of_bound(const core::Image& image, const reference::Truth& truth) {
  double largest = 0;
  for (std::size_t i = 0; i < truth.rgba.size(); ++i) {
    const double error = std::abs(static_cast<double>(image.rgba[i]) - truth.rgba[i]);
    if (error > 0) largest = std::max(largest, error / truth.bound[i / 4]);
  }
  return largest;
}

}  // namespace triptych::contract
