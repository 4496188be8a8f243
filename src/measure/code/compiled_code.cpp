#include "measure/code/compiled_code.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <utility>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "measure/code/amd_assembly.hpp"

namespace triptych::measure {
namespace {

void add_loop(const InstructionCounts& loop, std::map<std::string, double>& statistics) {
  statistics["Loop vector"] = loop.vector;
  statistics["Loop scalar"] = loop.scalar;
  statistics["Loop memory"] = loop.memory;
  statistics["Loop branches"] = loop.branch;
  statistics["Loop fetches"] = loop.fetches;
}

bool counts_instructions(const std::map<std::string, double>& statistics) {
  return std::ranges::any_of(
      statistics, [](const auto& each) { return each.first.starts_with("Instruction"); });
}

// Counts the instructions in a disassembly, and adds the counts to the statistics. `reported`
// states whether the driver itself reports the number of instructions. If it does not, waits are
// neither counted nor compared, because these drivers compile with LLVM, whose placement of waits
// differs from run to run: it depends on the addresses of objects in the compiler's memory.
void add_counted(std::string_view assembly, bool reported,
                 std::map<std::string, double>& statistics) {
  const auto counts = count_amd_instructions(assembly);
  if (!counts) return;
  const auto number_of = [&](const InstructionCounts& counted) {
    return reported ? counted.all() : counted.all() - counted.wait;
  };
  if (!reported) statistics["Instructions"] = number_of(counts->all);
  if (!counts->sampling_loop) return;
  add_loop(*counts->sampling_loop, statistics);
  statistics["Loop instructions"] = number_of(*counts->sampling_loop);
  if (reported) statistics["Loop waits"] = counts->sampling_loop->wait;
}

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

}  // namespace

void CompiledCode::add(const std::string& name, std::map<std::string, double> statistics,
                       std::string assembly) {
  // Removes the hashes that some drivers report among their statistics. A hash does not describe
  // the quality of the code, and it changes with the names in a shader.
  std::erase_if(statistics, [](const auto& each) {
    return each.first.find("hash") != std::string::npos ||
           each.first.find("Hash") != std::string::npos;
  });
  record::Executable executable{.statistics = std::move(statistics)};
  if (!assembly.empty()) {
    const bool reported = counts_instructions(executable.statistics);
    add_counted(assembly, reported, executable.statistics);
    executable.assembly = core::content_hash(reported ? assembly : without_waits(assembly));
    compiled_.listings.emplace(executable.assembly, std::move(assembly));
  }
  if (executable.statistics.empty() && executable.assembly.empty()) return;
  std::string unique = name;
  for (int n = 2; compiled_.code.contains(unique); ++n) unique = fmt::format("{}#{}", name, n);
  compiled_.code.emplace(std::move(unique), std::move(executable));
}

Compiled CompiledCode::take() {
  if (compiled_.code.empty()) {
    throw core::NotSupported("this driver reports no statistics for the code that it generates");
  }
  return std::exchange(compiled_, {});
}

std::map<std::string, double> parse_statistics(std::string_view line) {
  std::map<std::string, double> statistics;
  for (std::size_t colon = line.find(": "); colon != std::string_view::npos;
       colon = line.find(": ", colon + 1)) {
    const std::size_t number = colon + 2;
    if (number >= line.size() || !is_digit(line[number])) continue;
    // The name begins after the previous number or colon.
    std::size_t begin = colon;
    while (begin > 0 && line[begin - 1] != ':' && !is_digit(line[begin - 1])) --begin;
    while (begin < colon && line[begin] == ' ') ++begin;
    double value = 0;
    const char* const end = line.data() + line.size();
    if (std::from_chars(line.data() + number, end, value).ec != std::errc{}) continue;
    if (begin < colon) statistics.emplace(line.substr(begin, colon - begin), value);
  }
  return statistics;
}

std::map<std::string, double> parse_counts(std::string_view line) {
  std::map<std::string, double> counts;
  for (std::size_t at = 0; at < line.size();) {
    const bool begins = is_digit(line[at]) && (at == 0 || line[at - 1] == ' ');
    const std::size_t end = line.find_first_not_of("0123456789.", at);
    if (!begins || end == std::string_view::npos || line[end] != ' ') {
      ++at;
      continue;
    }
    double value = 0;
    std::from_chars(line.data() + at, line.data() + end, value);
    const std::size_t last = std::min(line.find_first_of(",\n", end), line.size());
    if (last > end + 1) counts.emplace(line.substr(end + 1, last - end - 1), value);
    at = last;
  }
  return counts;
}

}  // namespace triptych::measure
