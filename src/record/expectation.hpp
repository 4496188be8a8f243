#pragma once
// What must hold of a stress case besides being right: relations between its picture and others,
// and bounds on its counters. A suite states them as data, and the judge checks them.

#include <array>
#include <map>
#include <string>
#include <variant>

namespace triptych::record {

// Another record of the same run and device, whose configuration differs only in these factors.
// Values are written as in the key of a configuration. There, data, camera and technique are always
// present, and any other factor only if it does not have its default value.
using Changed = std::map<std::string, std::string>;

// The picture equals that of another configuration.
struct SamePicture {
  Changed changed;
  bool mirrored_x = false;  // left and right exchanged
  bool mirrored_y = false;  // top and bottom exchanged
  // Pixel (0, 0) shows what the other picture, which may be larger, shows at this position.
  std::array<int, 2> at{0, 0};
  bool to_the_bit = true;  // otherwise within the sum of both pictures' bounds
  bool same_ids = true;  // if not: the particles are numbered differently, and ids are not compared
  float depth_scale = 1;  // depths of the other picture over depths of this one; a power of two
};

// Every pixel has this colour, to the bit.
struct OneColour {
  std::array<float, 4> rgba{};
};

// The counter `counter` is at most `factor` times the counter `of` (times 1 where `of` is empty).
// `of` is read from the same record or, where `changed` names one, from another.
struct CountAtMost {
  std::string counter;
  double factor = 0;
  std::string of = {};
  Changed changed = {};
};

// A device may skip the case with a reason, and that is right: the case exceeds limits that devices
// may have. A device that does not skip it has to draw it.
struct MayBeRefused {};

struct Expectation {
  std::string what;  // one line for people: what is expected, and why
  std::variant<SamePicture, OneColour, CountAtMost, MayBeRefused> rule;
};

}  // namespace triptych::record
