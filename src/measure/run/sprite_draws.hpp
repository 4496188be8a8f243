#pragma once
// The history of one pixel of a particle scene: the device draws each sphere that the pixel's ray
// may meet alone, with the technique, the camera and the device code of the whole frame.

#include <map>
#include <string>

#include "accuracy/sprite_history.hpp"
#include "core/image.hpp"
#include "measure/contract/pixel_history.hpp"

namespace triptych::measure {

// The data on which the reference depends.
struct Described {
  const Configuration& configuration;
  const std::map<std::string, double>& precision;  // Record::precision
};

[[nodiscard]] accuracy::ShownSurface shown_at(const core::Image& image, PixelPlace place);

// `whole` is the result of the frame with all particles. If it is wrong but no sphere alone is
// wrong, the device draws fewer and fewer particles as long as the pixel is still wrong. Throws
// NotSupported if the suite does not implement ExpectsSprites, and the errors of the device.
[[nodiscard]] accuracy::SpriteHistory sprite_history(Device& device, const Work& work, Suite& suite,
                                                     const Described& described, PixelPlace place,
                                                     const accuracy::ShownSurface& whole);

}  // namespace triptych::measure
