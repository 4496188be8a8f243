#pragma once
// A volume's picture against the truth.

#include <cmath>

#include "reference/volume.hpp"
#include "suites/volume/tolerance.hpp"
#include "under_test.hpp"

namespace triptych::contract {

// Every channel of every pixel within the bound that is derived for the device's path.
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

}  // namespace triptych::contract
