#include "suites/volume/pixel_history.hpp"

#include "core/error.hpp"
#include "reference/ray_history.hpp"

namespace triptych::volume_suite {
namespace {

accuracy::AllowedRange around(double value, double error) {
  return {value, value - error, value + error};
}

accuracy::AllowedRange around(const reference::Bounded& bounded) {
  return around(bounded.value, bounded.error);
}

accuracy::ExpectedSample expected_sample(const reference::HistorySample& sample) {
  const reference::TableLookup& lookup = sample.lookup;
  accuracy::ExpectedSample expected{
      .index = sample.index,
      .position = {around(sample.place.x, sample.place_error.x),
                   around(sample.place.y, sample.place_error.y),
                   around(sample.place.z, sample.place_error.z)},
      .front = {},
      .value = around(sample.value),
      .colour = {around(lookup.colour[0], lookup.colour_error[0]),
                 around(lookup.colour[1], lookup.colour_error[1]),
                 around(lookup.colour[2], lookup.colour_error[2])},
      .alpha = accuracy::AllowedRange{lookup.alpha, lookup.alpha_lo, lookup.alpha_hi},
      .length = {sample.length.nominal, sample.length.shortest, sample.length.longest},
      .opacity = {sample.opacity.nominal, sample.opacity.lo, sample.opacity.hi}};
  if (sample.front) {
    expected.front = around(*sample.front);
    expected.alpha.reset();
  }
  return expected;
}

}  // namespace

accuracy::ExpectedRay pixel_history(const scene::VolumeScene& scene,
                                    const reference::ErrorModel& model, int x, int y) {
  if (scene.quadrature == scene::Quadrature::cells) {
    throw core::NotSupported(
        "--pixel requires quadrature=midpoint or quadrature=preintegrated, because it compares "
        "samples by their index, and the pieces of quadrature=cells have no index");
  }
  const reference::RayHistory history = reference::ray_history(scene, model, x, y);
  accuracy::ExpectedRay ray{.entry = {history.entry.x, history.entry.y, history.entry.z},
                            .stride = {history.stride.x, history.stride.y, history.stride.z},
                            .samples = {},
                            .ends_below = model.ert,
                            .merges = model.adapt > 0};
  ray.samples.reserve(history.samples.size());
  for (const reference::HistorySample& sample : history.samples) {
    ray.samples.push_back(expected_sample(sample));
  }
  return ray;
}

}  // namespace triptych::volume_suite
