#pragma once
// Instructions in the disassembly of AMD GPUs, as ACO and LLVM print it: one per line, basic blocks
// named "BB3:" (ACO) or "BB0_3:" (LLVM).

#include <optional>
#include <string_view>

namespace triptych::measure {

struct InstructionCounts {
  int vector = 0;
  int scalar = 0;
  int memory = 0;  // loads, stores, image samples and local memory, scalar loads included
  int branch = 0;
  int wait = 0;     // waits, scheduling hints, the end of the program
  int fetches = 0;  // the part of `memory` that reads images and buffers, as sampling a volume does
  [[nodiscard]] int all() const { return vector + scalar + memory + branch + wait; }
};

struct AssemblyCounts {
  InstructionCounts all;
  // One iteration of the innermost loop that samples the volume, both sides of every branch
  // included. Among the loops that contain no other loop, it is the one that reads through a
  // sampler, else from an image, else from a texel buffer, else from memory. Absent if there is no
  // such loop or more than one, because then it is not certain which one samples the volume.
  std::optional<InstructionCounts> sampling_loop;
  int sampling_loops = 0;  // how many candidates there were
};

// Returns nullopt if the text is not the disassembly of an AMD GPU.
[[nodiscard]] std::optional<AssemblyCounts> count_amd_instructions(std::string_view assembly);

}  // namespace triptych::measure
