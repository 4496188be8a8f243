#pragma once
// What volume_math.h needs to be C++: for the host's own use and for testing the same vectors that
// the shading languages are tested with.

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>

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
#define TRI_PRECISE

namespace triptych::technique::portable {
#include "technique/portable/sphere_math.h"
#include "technique/portable/volume_math.h"
#include "technique/portable/volume_preintegration.h"
}  // namespace triptych::technique::portable
