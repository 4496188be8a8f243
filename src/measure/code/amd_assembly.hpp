#pragma once
// Counts instructions in the disassembly of code for AMD GPUs, as ACO and LLVM print it: one
// instruction per line, with basic blocks named "BB3:" (ACO) or "BB0_3:" (LLVM).

#include <optional>
#include <string_view>

namespace triptych::measure {

struct InstructionCounts {
  int vector = 0;
  int scalar = 0;
  int memory = 0;  // loads (also scalar loads), stores, image samples, local memory
  int branch = 0;
  int wait = 0;     // waits, scheduling hints, the end of the program
  int fetches = 0;  // the part of `memory` that reads images and buffers, like volume sampling
  [[nodiscard]] int all() const { return vector + scalar + memory + branch + wait; }
};

struct AssemblyCounts {
  InstructionCounts all;
  // One iteration of the innermost loop that samples the volume, including both sides of every
  // branch. Only loops that contain no other loop are candidates. Those that read through a sampler
  // are preferred, then those that read from an image, from a texel buffer and from memory. Absent
  // unless exactly one loop is preferred, because otherwise it is uncertain which loop samples the
  // volume.
  std::optional<InstructionCounts> sampling_loop;
  int sampling_loops = 0;  // the number of preferred loops
};

// Returns nullopt if the text is not a disassembly of code for an AMD GPU.
[[nodiscard]] std::optional<AssemblyCounts> count_amd_instructions(std::string_view assembly);

}  // namespace triptych::measure
