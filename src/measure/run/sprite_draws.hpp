#pragma once
// Determines the history of one pixel of a particle scene. For each sphere that the pixel's ray may
// hit, the device draws a frame that contains only this sphere. The technique, the camera and the
// device code are the same as for the complete frame.

#include <map>
#include <string>

#include "accuracy/sprite_history.hpp"
#include "core/image.hpp"
#include "measure/contract/pixel_history.hpp"

namespace triptych::measure {

// The scene and the device properties for which the reference renderer computes results.
struct ReferenceInput {
  const Configuration& configuration;
  const std::map<std::string, double>& precision;  // Record::precision
};

[[nodiscard]] accuracy::DrawnSurface shown_at(const core::Image& image, PixelPlace place);

// Returns the history of the pixel. `whole` is the device's result for this pixel if all particles
// are drawn. If that result is wrong although each sphere alone is drawn correctly, the function
// searches for a small set of particles with which the pixel is still wrong. Throws NotSupported if
// the suite does not implement SpriteReference. Also throws the exceptions of the device's
// functions.
[[nodiscard]] accuracy::SpriteHistory sprite_history(Device& device, const Work& work, Suite& suite,
                                                     const ReferenceInput& input, PixelPlace place,
                                                     const accuracy::DrawnSurface& whole);

}  // namespace triptych::measure
