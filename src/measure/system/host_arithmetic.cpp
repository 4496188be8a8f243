#include "measure/system/host_arithmetic.hpp"

#include <cfenv>
#include <limits>

namespace triptych::measure {
namespace {

bool flushes_subnormals() {
  volatile float smallest = std::numeric_limits<float>::min();
  volatile float half = smallest * 0.5F;
  return half == 0;
}

std::string rounding_mode() {
  switch (std::fegetround()) {
    case FE_TONEAREST:
      return {};
    case FE_UPWARD:
      return "upward";
    case FE_DOWNWARD:
      return "downward";
    case FE_TOWARDZERO:
      return "toward zero";
    default:
      return "in an unknown way";
  }
}

}  // namespace

std::string restore_arithmetic() {
  const std::string rounding = rounding_mode();
  if (rounding.empty() && !flushes_subnormals()) return {};
  std::fesetenv(FE_DFL_ENV);
  return rounding.empty() ? std::string()
                          : "the process rounds " + rounding + " instead of to nearest";
}

}  // namespace triptych::measure
