#include "scene/half.hpp"

#include <cmath>
#include <limits>

namespace triptych::scene {
namespace {

constexpr int fraction_bits = 10;
constexpr int bias = 15;
constexpr unsigned hidden = 1U << fraction_bits;
constexpr unsigned infinity = 0x7c00;

}  // namespace

Half::operator double() const {
  const unsigned magnitude = bits & 0x7fffU;
  const int exponent = static_cast<int>(magnitude >> fraction_bits);
  const unsigned fraction = magnitude & (hidden - 1);
  double value = 0;
  if (magnitude > infinity) {
    value = std::numeric_limits<double>::quiet_NaN();
  } else if (magnitude == infinity) {
    value = std::numeric_limits<double>::infinity();
  } else if (exponent == 0) {
    value = std::ldexp(fraction, 1 - bias - fraction_bits);
  } else {
    value = std::ldexp(hidden + fraction, exponent - bias - fraction_bits);
  }
  return (bits & 0x8000U) != 0 ? -value : value;
}

// Imath and glm cannot be used, because they convert from float, and a double would be rounded
// twice. Here the value is rounded to a multiple of the spacing between neighbouring halves. If the
// result is the next power of two, the rounding carries into the exponent.
Half to_half(double value) {
  const double size = std::abs(value);
  unsigned bits = infinity;
  if (std::isnan(value)) {
    bits = infinity | (hidden >> 1U);
  } else if (size < least_normal_half) {
    bits = static_cast<unsigned>(std::nearbyint(std::ldexp(size, bias - 1 + fraction_bits)));
  } else if (size < 65520) {
    const int exponent = std::ilogb(size);
    const auto quanta =
        static_cast<unsigned>(std::nearbyint(std::ldexp(size, fraction_bits - exponent)));
    bits = (static_cast<unsigned>(exponent + bias) << fraction_bits) + (quanta - hidden);
  }
  return {static_cast<std::uint16_t>(bits | (std::signbit(value) ? 0x8000U : 0U))};
}

}  // namespace triptych::scene
