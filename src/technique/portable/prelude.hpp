#pragma once
// Defines the macros that make volume_math.h and the other .h files of this folder valid C++. The
// host calls their functions, and tests compare the results with those of the shading languages for
// the same inputs.

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <numbers>

#define TRI_FN [[nodiscard]] inline
#define TRI_FLOAT2 glm::vec2
#define TRI_MAKE_FLOAT2(x, y) glm::vec2((x), (y))
#define TRI_AS_INT(x) std::bit_cast<std::int32_t>(x)
#define TRI_AS_FLOAT(x) std::bit_cast<float>(x)
#define TRI_FLOOR(x) std::floor(x)
#define TRI_CEIL(x) std::ceil(x)
#define TRI_SQRT(x) std::sqrt(x)
#define TRI_INT(x) static_cast<int>(x)
#define TRI_TO_FLOAT(x) static_cast<float>(x)
#define TRI_TO_REAL(x) static_cast<real>(x)
#define TRI_MAKE_REAL2(x, y) real2((x), (y))
#define TRI_PRECISE

namespace triptych::technique::portable {
using real = float;
using real2 = glm::vec2;
#define TRI_PRECISION 32
#include "technique/portable/box_math.h"
#include "technique/portable/sphere_math.h"
#include "technique/portable/volume_math.h"
#include "technique/portable/volume_preintegration.h"
#undef TRI_PRECISION
}  // namespace triptych::technique::portable

// Includes volume_math.h again, in double precision.
namespace triptych::technique::portable::fp64 {
using real = double;
using real2 = glm::dvec2;
[[nodiscard]] inline std::int32_t high_word(double x) {
  return static_cast<std::int32_t>(std::bit_cast<std::int64_t>(x) >> 32);
}
[[nodiscard]] inline double with_high_word(double x, std::int32_t word) {
  const std::int64_t low = std::bit_cast<std::int64_t>(x) & 0xffffffff;
  return std::bit_cast<double>(std::int64_t{word} << 32 | low);
}
#define TRI_PRECISION 64
#define TRI_HIGH_WORD(x) high_word(x)
#define TRI_WITH_HIGH_WORD(x, word) with_high_word(x, word)
#define TRI_LN2 std::numbers::ln2
#define TRI_2_OVER_LN2 (2 / std::numbers::ln2)
#define TRI_RATIO(a, b) (static_cast<real>(a) / static_cast<real>(b))
#include "technique/portable/volume_math.h"
#undef TRI_PRECISION
}  // namespace triptych::technique::portable::fp64
