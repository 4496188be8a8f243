#pragma once
#include "core/image.hpp"

namespace triptych::accuracy {

// The right picture of a configuration and how far a device's may be from it.
struct TruthPair {
  core::Image truth;
  core::Image bound;  // per pixel, same value in all channels
};

}  // namespace triptych::accuracy
