#pragma once
#include <span>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::report {

struct ScreenOptions {
  std::string store_option = {};  // " --store FILE" for printed commands; empty for the default
  bool colours = false;
  std::size_t width = 100;  // width of the terminal, in characters
};

// Returns the last output of a command that judges. It has at most 40 lines: the verdict, one row
// for each check over all plans, the findings grouped by cause, each with a command that reproduces
// it, the names of written files, and the meaning of the exit code. `seconds` is the run time of
// the command.
[[nodiscard]] std::string summary_screen(std::span<const judge::GateResult> results, double seconds,
                                         std::span<const std::string> files,
                                         const ScreenOptions& options = {});

}  // namespace triptych::report
