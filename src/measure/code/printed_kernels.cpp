#include "measure/code/printed_kernels.hpp"

#include <utility>

#include "measure/code/compiled_code.hpp"
#include "measure/code/consume_line.hpp"

namespace triptych::measure {
namespace {

// Returns the kernel's name in a line such as "=== Printing nir for 'raycast' after spirv_to_nir"
// or "=== Printing nir variant 'Default' for 'raycast' before driver finalization". Returns an
// empty string for all other lines.
std::string_view kernel_in(std::string_view line) {
  constexpr std::string_view start = "=== Printing nir ";
  constexpr std::string_view before_name = "for '";
  if (!line.starts_with(start)) return {};
  const std::size_t at = line.find(before_name, start.size());
  if (at == std::string_view::npos) return {};
  line.remove_prefix(at + before_name.size());
  return line.substr(0, line.find('\''));
}

}  // namespace

std::vector<PrintedKernel> parse_printed_kernels(std::string_view printed) {
  enum class Part { other, disassembly, statistics };
  std::vector<PrintedKernel> kernels;
  std::string name;
  int variants = 0;  // number of variants of the current kernel so far
  Part part = Part::other;
  PrintedKernel kernel;
  while (!printed.empty()) {
    const std::string_view line = consume_line(printed);
    if (const std::string_view next = kernel_in(line); !next.empty()) {
      if (next != name) variants = 0;
      name = next;
      part = Part::other;
    } else if (line.ends_with("disassembly:")) {
      kernel = {.name = variants == 0 ? name : name + " (optimized)"};
      part = Part::disassembly;
    } else if (line.starts_with("*** SHADER STATS ***")) {
      part = Part::statistics;
    } else if (part == Part::disassembly) {
      kernel.assembly.append(line).append("\n");
    } else if (part == Part::statistics && line.starts_with("***")) {
      if (!name.empty()) {
        kernels.push_back(std::exchange(kernel, {}));
        ++variants;
      }
      part = Part::other;
    } else if (part == Part::statistics) {
      kernel.statistics.merge(parse_statistics(line));
    }
  }
  return kernels;
}

}  // namespace triptych::measure
