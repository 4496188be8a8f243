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
  const bool flushes = flushes_subnormals();
  if (rounding.empty() && !flushes) return {};
  std::fesetenv(FE_DFL_ENV);
  std::string changed;
  if (!rounding.empty()) changed = "the process rounds " + rounding + " instead of to nearest";
  if (flushes) {
    changed += changed.empty() ? "" : ", and ";
    changed += "subnormal numbers are taken for 0";
  }
  return changed;
}

}  // namespace triptych::measure
