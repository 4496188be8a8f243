#pragma once
#include <span>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::report {

struct ScreenOptions {
  std::string store_option = {};  // " --store FILE" for printed commands, if it is not the default
  bool colours = false;
  std::size_t width = 100;  // width of the terminal, in characters
};

// The last output of a command that judges, in at most 40 lines: the verdict, a row for each kind
// of check over all plans, the findings by cause, each with the command that reproduces it, the
// files, and the meaning of the exit code. `seconds` is the time that the command took.
[[nodiscard]] std::string last_screen(std::span<const judge::GateResult> results, double seconds,
                                      std::span<const std::string> files,
                                      const ScreenOptions& options = {});

}  // namespace triptych::report
