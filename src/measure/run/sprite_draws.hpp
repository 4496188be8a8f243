#pragma once
// Determines the history of one pixel of a particle scene. For each sphere that the pixel's ray may
// hit, the device draws a frame that contains only this sphere, with the technique, the camera and
// the device code of the whole frame.

#include <map>
#include <string>

#include "accuracy/sprite_history.hpp"
#include "core/image.hpp"
#include "measure/contract/pixel_history.hpp"

namespace triptych::measure {

// The arguments of the reference renderer.
struct Described {
  const Configuration& configuration;
  const std::map<std::string, double>& precision;  // Record::precision
};

[[nodiscard]] accuracy::ShownSurface shown_at(const core::Image& image, PixelPlace place);

// Returns the history of the pixel. `whole` is the pixel in the frame with all particles. If it is
// wrong although each sphere alone is drawn correctly, the device draws fewer and fewer particles
// as long as the pixel remains wrong. Throws NotSupported if the suite does not implement
// ExpectsSprites, and the errors of the device.
[[nodiscard]] accuracy::SpriteHistory sprite_history(Device& device, const Work& work, Suite& suite,
                                                     const Described& described, PixelPlace place,
                                                     const accuracy::ShownSurface& whole);

}  // namespace triptych::measure
