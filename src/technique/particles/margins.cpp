#include "technique/particles/margins.hpp"

#include <algorithm>
#include <cmath>

namespace triptych::technique {

double point_margin(std::string_view renderer, double granularity) {
  // softpipe draws a point of size s as ⌊s⌋×⌊s⌋ pixels, beginning at the integer coordinate next to
  // the point's lower end. If the point is two pixels larger, it contains every pixel whose centre
  // is in the intended square.
  if (renderer.starts_with("softpipe")) return 2;
  // llvmpipe snaps points to 1/256 pixel, as it does any vertex, regardless of the granularity that
  // it reports. The margin of the sprites already covers this. lavapipe also reports the name
  // llvmpipe.
  if (renderer.starts_with("llvmpipe")) return 0;
  return granularity;
}

double sprite_growth(int sub_pixel_bits) {
  return std::max(0.0, 2 * std::ldexp(1.0, -sub_pixel_bits) - 1.0 / 64);
}

}  // namespace triptych::technique
