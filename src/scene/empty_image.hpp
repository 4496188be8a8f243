#pragma once
#include <array>
#include <string>

#include "scene/transfer_function.hpp"
#include "scene/volume.hpp"

namespace triptych::scene {

// How the values of a volume are mapped to the transfer function (see Mapping).
struct ValueMapping {
  double lo = 0;
  double hi = 1;
  Mapping mapping = Mapping::linear;
  std::array<double, 2> used{0, 1};  // see Volume::used
};

// Returns a note if the transfer function is transparent for all values of a volume, so that every
// image of it is empty. The note states for which values the transfer function is visible. Returns
// an empty string if the image may show something.
[[nodiscard]] std::string empty_image_note(const TransferFunction& function,
                                           const ValueMapping& values);

}  // namespace triptych::scene
