#pragma once
// Sentences about the code that GPU compilers generated.

#include <string>

#include "judge/code/code_change.hpp"
#include "judge/code/code_totals.hpp"

namespace triptych::report::words {

// Returns the changes: "occupancy 16 → 12 (VGPRs 84 → 100), inverse throughput 332 → 368 (+11 %)".
// If there are several executables, the name of each precedes its changes.
[[nodiscard]] std::string text_of(const judge::CodeComparison& comparison);
// Returns the total in the format of Mesa's shader-db: "35678819 -> 35361617 (-0.89%); split:
// -0.91%, +0.02%; helped: 2, hurt: 1; worst: CONFIGURATION (657 -> 660)".
[[nodiscard]] std::string text_of(const judge::CodeTotal& total);

}  // namespace triptych::report::words
