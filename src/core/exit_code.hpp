#pragma once
#include <algorithm>
#include <array>

#include "core/error.hpp"

namespace triptych::core {

// Returns the more severe of two exit codes. From most to least severe, the order is usage,
// regression, cannot_judge, skip, pass.
[[nodiscard]] inline ExitCode worse_of(ExitCode a, ExitCode b) {
  constexpr std::array by_weight{ExitCode::pass, ExitCode::skip, ExitCode::cannot_judge,
                                 ExitCode::regression, ExitCode::usage};
  return std::max(a, b, [&](ExitCode one, ExitCode other) {
    return std::ranges::find(by_weight, one) < std::ranges::find(by_weight, other);
  });
}

}  // namespace triptych::core
