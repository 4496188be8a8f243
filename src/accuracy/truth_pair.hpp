#pragma once
#include "core/image.hpp"

namespace triptych::accuracy {

// The reference image of a configuration, and the largest error that a device's image may have.
struct TruthPair {
  core::Image truth;
  core::Image bound;  // error bound of each pixel, equal in all channels
};

}  // namespace triptych::accuracy
