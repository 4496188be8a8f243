#pragma once
// Conditions that a stress case (a scene on which renderers often fail) must satisfy in addition to
// its error bound: relations between its image and other images, and limits for its counters. A
// suite declares them as data, and the judge (src/judge) checks them.

#include <array>
#include <map>
#include <string>
#include <variant>

namespace triptych::record {

// Selects another record of the same run and device. The map contains the factors in which the
// configuration of the other record differs, and their values there. Values are written as in the
// key of a configuration. Such a key always contains data, camera and technique, and any other
// factor only if it does not have its default value.
using Changed = std::map<std::string, std::string>;

// The image must equal the image of another configuration.
struct SameImage {
  Changed changed;
  bool mirrored_x = false;  // whether the other image is mirrored horizontally
  bool mirrored_y = false;  // whether the other image is mirrored vertically
  // The position in the other image that corresponds to pixel (0, 0) of this image. The other image
  // may be larger.
  std::array<int, 2> at{0, 0};
  // If false, the images need only be equal within the sum of their bounds.
  bool bit_identical = true;
  // If false, the ids of the particles that the pixels show are not compared, because the two
  // images number the particles differently.
  bool compare_ids = true;
  float depth_scale = 1;  // depth in the other image divided by depth in this image; a power of two
};

// Every pixel must have exactly this colour.
struct UniformColour {
  std::array<float, 4> rgba{};
};

// The counter `counter` must be at most `factor` times the counter `of`, or at most `factor` if
// `of` is empty. The counter `of` is read from the same record, or from another record if `changed`
// selects one.
struct CountAtMost {
  std::string counter;
  double factor = 0;
  std::string of = {};
  Changed changed = {};
};

// A device may skip the case and state a reason, because the case exceeds limits that some devices
// have. A device that does not skip the case must draw it correctly.
struct MayBeRefused {};

struct Expectation {
  std::string what;  // states the expectation and the reason for it on one line
  std::variant<SameImage, UniformColour, CountAtMost, MayBeRefused> rule;
};

}  // namespace triptych::record
