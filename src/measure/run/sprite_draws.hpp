#pragma once
// The history of one pixel of a particle scene: the device draws each sphere that the pixel's ray
// may meet alone, with the technique, the camera and the device code of the whole frame.

#include <map>
#include <string>

#include "accuracy/sprite_history.hpp"
#include "core/image.hpp"
#include "measure/contract/pixel_history.hpp"

namespace triptych::measure {

// What the reference depends on.
struct Described {
  const Configuration& configuration;
  const std::map<std::string, double>& precision;  // Record::precision
};

[[nodiscard]] accuracy::ShownSurface shown_at(const core::Image& image, PixelPlace place);

// `whole` is what the frame with all particles shows. If it is wrong and no sphere alone is, the
// device draws ever fewer particles as long as the pixel is still wrong. Throws NotSupported if the
// suite does not implement ExpectsSprites, and what the device throws.
[[nodiscard]] accuracy::SpriteHistory sprite_history(Device& device, const Work& work, Suite& suite,
                                                     const Described& described, PixelPlace place,
                                                     const accuracy::ShownSurface& whole);

}  // namespace triptych::measure
