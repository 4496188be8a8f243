#pragma once
// What must hold of a stress case beside its truth: relations between pictures, and bounds on what
// was counted. A suite states them as data, the judge checks them.

#include <array>
#include <map>
#include <string>
#include <variant>

namespace triptych::record {

// Another record of the same run and device: the same configuration but for these factors. Their
// values as in a configuration's key, where data, camera and technique always stand and any other
// factor only where it has not its default.
using Changed = std::map<std::string, std::string>;

// The picture is that of another configuration.
struct SamePicture {
  Changed changed;
  bool mirrored_x = false;  // left and right exchanged
  bool mirrored_y = false;  // top and bottom exchanged
  // Pixel (0, 0) shows what the other picture shows at this place, which may be larger.
  std::array<int, 2> at{0, 0};
  bool to_the_bit = true;  // else to both pictures' bounds together
  bool same_ids = true;    // else particles are numbered otherwise, and ids are not compared
  float depth_scale = 1;   // a power of two: of these depths to those of the other picture
};

// Every pixel has this colour, to the bit.
struct OneColour {
  std::array<float, 4> rgba{};
};

// counter ≤ factor · (counter `of`; 1 where that is empty), the latter of the same record or, where
// `changed` names one, of another.
struct CountAtMost {
  std::string counter;
  double factor = 0;
  std::string of = {};
  Changed changed = {};
};

// A device that skips the case, with a reason, has done what is right: the case exceeds limits that
// devices may have. One that does not has to draw it.
struct MayBeRefused {};

struct Expectation {
  std::string what;  // one line for people: what is expected and why
  std::variant<SamePicture, OneColour, CountAtMost, MayBeRefused> rule;
};

}  // namespace triptych::record
