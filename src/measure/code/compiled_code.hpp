#pragma once
// Collects what a compiler reports of the executables of a configuration.

#include <map>
#include <string>
#include <string_view>

#include "measure/contract/backend.hpp"

namespace triptych::measure {

class CompiledCode {
 public:
  // Adds an executable; a second one of the same name becomes "NAME#2". What Triptych counts in the
  // disassembly of a GPU whose instructions it knows is added to the statistics: "Instructions"
  // where the driver does not report them, and "Loop …" of the loop that samples the volume.
  void add(const std::string& name, std::map<std::string, double> statistics,
           std::string assembly);

  // Throws core::NotSupported where nothing was reported.
  [[nodiscard]] Compiled take();

 private:
  Compiled compiled_;
};

// Reads "Name: NUMBER" pairs of one line, as Mesa's drivers print statistics; text before the first
// pair, and what is in parentheses, is left out.
[[nodiscard]] std::map<std::string, double> parse_statistics(std::string_view line);

// The same of "NUMBER name" pairs, as in "Used 32 registers, 8 bytes stack frame" (NVIDIA) or
// "55 inst, 0 loops, 328 cycles" (Intel): each number with the words up to the next comma.
[[nodiscard]] std::map<std::string, double> parse_counts(std::string_view line);

}  // namespace triptych::measure
