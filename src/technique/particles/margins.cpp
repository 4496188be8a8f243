#include "technique/particles/margins.hpp"

#include <algorithm>
#include <cmath>

namespace triptych::technique {

double point_margin(std::string_view renderer, double granularity) {
  // Draws a point of size s as ⌊s⌋ pixels from the whole one next to its lower end: in a point of
  // two pixels more, every pixel whose centre lies in the square is drawn.
  if (renderer.starts_with("softpipe")) return 2;
  // Whatever it tells, it snaps points to 1/256 pixel as it does any vertex, for which the sprites'
  // own margin is made. It is lavapipe's name for itself, too.
  if (renderer.starts_with("llvmpipe")) return 0;
  return granularity;
}

double sprite_growth(int sub_pixel_bits) {
  return std::max(0.0, 2 * std::ldexp(1.0, -sub_pixel_bits) - 1.0 / 64);
}

}  // namespace triptych::technique
