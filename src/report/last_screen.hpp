#pragma once
#include <span>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::report {

struct ScreenOptions {
  bool colours = false;
  std::size_t width = 100;  // of the terminal, in characters
};

// What a command that judges says last, at most 40 lines: the verdict, a row per kind of check over
// all plans, the findings by cause with the command that shows each again, where the files are and
// what the exit code means. `seconds`: that it took.
[[nodiscard]] std::string last_screen(std::span<const judge::GateResult> results, double seconds,
                                      std::span<const std::string> files,
                                      const ScreenOptions& options = {});

}  // namespace triptych::report
