#pragma once
// Counts the instructions in a disassembly of code for AMD GPUs, in the formats of ACO and LLVM:
// one instruction per line, with basic blocks named "BB3:" (ACO) or "BB0_3:" (LLVM).

#include <optional>
#include <string>
#include <string_view>

namespace triptych::measure {

struct InstructionCounts {
  int vector = 0;
  int scalar = 0;
  int memory = 0;  // loads (including scalar loads), stores, image samples, local-memory accesses
  int branch = 0;
  int wait = 0;  // waits, scheduling hints, the end of the program
  // The part of `memory` that may sample a volume: loads from images, buffers and global memory.
  int fetches = 0;
  [[nodiscard]] int all() const { return vector + scalar + memory + branch + wait; }
};

struct AssemblyCounts {
  InstructionCounts all;
  // The instructions of one iteration of the innermost loop that samples the volume, including both
  // sides of every branch. Only loops that contain no other loop are candidates. Candidates that
  // read through a sampler are preferred, then those that read from an image, from a texel buffer,
  // and from memory. If several candidates are equally preferred, it is uncertain which of them
  // samples the volume, so the counts are absent.
  std::optional<InstructionCounts> sampling_loop;
  int sampling_loops = 0;  // the number of equally preferred candidates
};

// Returns nullopt if the text is not a disassembly of code for an AMD GPU.
[[nodiscard]] std::optional<AssemblyCounts> count_amd_instructions(std::string_view assembly);

// Returns the disassembly without the lines that contain a wait or a scheduling hint.
[[nodiscard]] std::string without_waits(std::string_view assembly);

}  // namespace triptych::measure
