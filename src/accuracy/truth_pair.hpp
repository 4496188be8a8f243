#pragma once
#include "core/image.hpp"

namespace triptych::accuracy {

// The reference image of a configuration, and the largest error that a device's image may have.
struct TruthPair {
  core::Image truth;
  core::Image bound;  // per pixel, with the same value in all channels
};

}  // namespace triptych::accuracy
