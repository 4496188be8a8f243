#pragma once
// Parses the output that rusticl on radeonsi prints to standard error while it builds a program, if
// the environment variables RUSTICL_DEBUG=nir and AMD_DEBUG=cs,asm are set. The output contains the
// names of the kernels, their disassembly and their statistics.

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::measure {

struct PrintedKernel {
  // The kernel's name. rusticl may compile a second variant of a kernel for the usual work-group
  // size. The name of this variant ends with " (optimized)".
  std::string name;
  std::map<std::string, double> statistics;
  std::string assembly;
};

// Returns the kernels in the order in which they were printed. Code that belongs to no kernel, such
// as a driver's own shaders, is left out.
[[nodiscard]] std::vector<PrintedKernel> parse_printed_kernels(std::string_view printed);

}  // namespace triptych::measure
