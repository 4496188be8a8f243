#include "measure/code/amd_assembly.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "measure/code/consume_line.hpp"

namespace triptych::measure {
namespace {

enum class Kind { vector, scalar, load, memory, branch, wait };

// The ways in which device code can read a volume, from the most to the least likely: through a
// sampler, from an image without a sampler, from a texel buffer, or from plain memory (OpenCL C).
// If a program uses several of these ways, the most likely way is assumed to read the volume, and
// all others to read lookup tables.
enum class Fetch { sample, image, texels, memory, none };

struct Line {
  Kind kind;
  Fetch fetch = Fetch::none;
  std::string target;  // the label to which a branch jumps
};

bool starts_with_any(std::string_view text, std::span<const std::string_view> starts) {
  return std::ranges::any_of(starts,
                             [&](std::string_view start) { return text.starts_with(start); });
}

// Returns the kind of an instruction, or nullopt if `operation` is not an instruction. The kinds
// and prefixes follow AMD's instruction set manuals.
std::optional<Kind> kind_of(std::string_view operation) {
  static constexpr std::array<std::string_view, 2> branches{"s_branch", "s_cbranch"};
  static constexpr std::array<std::string_view, 13> waits{
      "s_wait",  "s_nop",     "s_endpgm", "s_clause", "s_delay_alu", "s_sendmsg", "s_barrier",
      "s_sleep", "s_setprio", "s_inst_",  "s_icache", "s_code_end",  "s_ttrace"};
  static constexpr std::array<std::string_view, 8> scalar_memory{
      "s_load",   "s_buffer_", "s_store",  "s_scratch_",
      "s_dcache", "s_memtime", "s_atomic", "s_prefetch"};
  static constexpr std::array<std::string_view, 7> loads{
      "image_sample", "image_load",  "image_gather", "buffer_load",
      "tbuffer_load", "global_load", "flat_load"};
  static constexpr std::array<std::string_view, 9> other_memory{
      "image_", "buffer_", "tbuffer_", "global_", "flat_", "scratch_", "ds_", "lds_", "exp"};
  if (starts_with_any(operation, branches)) return Kind::branch;
  if (starts_with_any(operation, waits)) return Kind::wait;
  if (starts_with_any(operation, scalar_memory)) return Kind::memory;
  if (starts_with_any(operation, loads)) return Kind::load;
  if (starts_with_any(operation, other_memory)) return Kind::memory;
  if (operation.starts_with("v_")) return Kind::vector;
  if (operation.starts_with("s_")) return Kind::scalar;
  return std::nullopt;
}

Fetch fetch_of(std::string_view operation) {
  if (operation.starts_with("image_sample") || operation.starts_with("image_gather")) {
    return Fetch::sample;
  }
  if (operation.starts_with("image_load")) return Fetch::image;
  if (operation.starts_with("buffer_load_format") || operation.starts_with("tbuffer_load")) {
    return Fetch::texels;
  }
  return Fetch::memory;
}

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

// Returns a label without its prefix, so that definitions and uses match. LLVM defines the label of
// a block as "BB0_3:" but refers to it as ".LBB0_3" in branches.
std::string label_of(std::string_view text) {
  if (text.starts_with('.')) text.remove_prefix(1);
  if (text.starts_with('L')) text.remove_prefix(1);
  return std::string(text);
}

std::string_view without_comment(std::string_view line) {
  return trimmed(line.substr(0, line.find(';')));
}

// Returns the first word of an instruction.
std::string_view operation_of(std::string_view instruction) {
  return instruction.substr(0, instruction.find_first_of(" \t"));
}

struct Program {
  std::vector<Line> lines;
  std::map<std::string, std::size_t> labels;  // label → index of the next line
};

Program parse(std::string_view assembly) {
  Program program;
  while (!assembly.empty()) {
    const std::string_view text = without_comment(consume_line(assembly));
    if (text.ends_with(':')) {
      program.labels.emplace(label_of(text.substr(0, text.size() - 1)), program.lines.size());
      continue;
    }
    const std::string_view operation = operation_of(text);
    const auto kind = kind_of(operation);
    if (!kind) continue;
    const bool jumps = *kind == Kind::branch;
    program.lines.push_back({*kind, *kind == Kind::load ? fetch_of(operation) : Fetch::none,
                             jumps ? label_of(trimmed(text.substr(operation.size()))) : ""});
  }
  return program;
}

InstructionCounts count(std::span<const Line> lines) {
  InstructionCounts counts;
  for (const Line& line : lines) {
    counts.vector += static_cast<int>(line.kind == Kind::vector);
    counts.scalar += static_cast<int>(line.kind == Kind::scalar);
    counts.memory += static_cast<int>(line.kind == Kind::memory || line.kind == Kind::load);
    counts.branch += static_cast<int>(line.kind == Kind::branch);
    counts.wait += static_cast<int>(line.kind == Kind::wait);
    counts.fetches += static_cast<int>(line.kind == Kind::load);
  }
  return counts;
}

// Returns a map from the index of the first line of each loop to the index after its last line. A
// branch back to a block ends a loop that begins at that block.
std::map<std::size_t, std::size_t> loops_of(const Program& program) {
  std::map<std::size_t, std::size_t> loops;
  for (std::size_t at = 0; at < program.lines.size(); ++at) {
    const auto target = program.labels.find(program.lines[at].target);
    if (target == program.labels.end() || target->second > at) continue;
    std::size_t& end = loops[target->second];
    end = std::max(end, at + 1);
  }
  return loops;
}

std::vector<std::span<const Line>> innermost_loops_of(const Program& program) {
  const auto loops = loops_of(program);
  std::vector<std::span<const Line>> innermost;
  for (const auto& [begin, end] : loops) {
    const bool contains_loop = std::ranges::any_of(
        loops, [&](const auto& other) { return other.first > begin && other.second <= end; });
    if (!contains_loop) {
      innermost.push_back(std::span(program.lines).subspan(begin, end - begin));
    }
  }
  return innermost;
}

}  // namespace

std::string without_waits(std::string_view assembly) {
  std::string result;
  while (!assembly.empty()) {
    const std::string_view line = consume_line(assembly);
    if (kind_of(operation_of(without_comment(line))) != Kind::wait) result.append(line) += '\n';
  }
  return result;
}

std::optional<AssemblyCounts> count_amd_instructions(std::string_view assembly) {
  const Program program = parse(assembly);
  const auto is_wait = [](const Line& line) { return line.kind == Kind::wait; };
  if (std::ranges::none_of(program.lines, is_wait)) return std::nullopt;
  AssemblyCounts counts{.all = count(program.lines), .sampling_loop = std::nullopt};
  Fetch most_likely = Fetch::none;
  for (const std::span<const Line> loop : innermost_loops_of(program)) {
    Fetch fetch = Fetch::none;
    for (const Line& line : loop) fetch = std::min(fetch, line.fetch);
    if (fetch == Fetch::none || fetch > most_likely) continue;
    counts.sampling_loops = fetch < most_likely ? 1 : counts.sampling_loops + 1;
    counts.sampling_loop = count(loop);
    most_likely = fetch;
  }
  if (counts.sampling_loops != 1) counts.sampling_loop.reset();
  return counts;
}

}  // namespace triptych::measure
