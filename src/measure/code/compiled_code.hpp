#pragma once
// Collects the compiler's report about the executables of a configuration.

#include <map>
#include <string>
#include <string_view>

#include "measure/contract/backend.hpp"

namespace triptych::measure {

class CompiledCode {
 public:
  // Adds an executable (a compiled shader stage or kernel); a second executable with the same name
  // becomes "NAME#2". If Triptych can parse the disassembly, it counts the instructions and adds
  // two kinds of statistics: "Instructions" (without waits), unless the driver reports the number
  // of instructions itself, and "Loop …" for the loop that samples the volume.
  void add(const std::string& name, std::map<std::string, double> statistics, std::string assembly);

  // Throws core::NotSupported if the compiler reported nothing.
  [[nodiscard]] Compiled take();

 private:
  Compiled compiled_;
};

// Parses a line of "Name: NUMBER" pairs, which is the format in which Mesa's drivers print
// statistics. Text before the first pair and text in parentheses is ignored.
[[nodiscard]] std::map<std::string, double> parse_statistics(std::string_view line);

// Parses a line of "NUMBER name" pairs, such as "Used 32 registers, 8 bytes stack frame" (NVIDIA)
// or "55 inst, 0 loops, 328 cycles" (Intel). The name consists of all words up to the next comma.
[[nodiscard]] std::map<std::string, double> parse_counts(std::string_view line);

}  // namespace triptych::measure
