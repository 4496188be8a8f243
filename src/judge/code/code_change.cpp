#include "judge/code/code_change.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <tuple>

namespace triptych::judge {
namespace {

struct NamedStatistic {
  std::string_view driver_name;  // in lower case
  CodeStatistic statistic;
};

namespace quantity {
constexpr CodeStatistic occupancy{"occupancy", "MaxWaves", true, false, 0};
constexpr CodeStatistic spilled_vgprs{"spilled VGPRs", "SpillVGPRs", true, true, 1};
constexpr CodeStatistic spilled_sgprs{"spilled SGPRs", "SpillSGPRs", true, true, 2};
constexpr CodeStatistic spills{"spills", "Spills", true, true, 1};
constexpr CodeStatistic fills{"fills", "Fills", true, true, 2};
constexpr CodeStatistic scratch{"scratch", "Scratch", true, true, 3};
constexpr CodeStatistic instructions{"instructions", "Instrs", true, true, 4};
constexpr CodeStatistic loop{"instructions per iteration", "LoopInstrs", true, true, 5};
constexpr CodeStatistic latency{"latency", "Latency", true, true, 6};
constexpr CodeStatistic throughput{"inverse throughput", "InvThroughput", true, true, 7};
constexpr CodeStatistic vgprs{"VGPRs", "VGPRs", false, true, 10};
constexpr CodeStatistic sgprs{"SGPRs", "SGPRs", false, true, 11};
constexpr CodeStatistic registers{"registers", "GPRs", false, true, 10};
constexpr CodeStatistic code_size{"code size", "CodeSize", false, true, 12};
constexpr CodeStatistic local{"local memory", "LDS", false, true, 13};
constexpr CodeStatistic branches{"branches", "Branches", false, true, 14};
constexpr CodeStatistic copies{"copies", "Copies", false, true, 15};
}  // namespace quantity

// The names under which RADV, radeonsi, NVK, NVIDIA's driver, ANV, iris and OpenCL report
// statistics, and the names of the statistics that Triptych itself counts in a disassembly.
constexpr std::array<NamedStatistic, 44> named_statistics{{
    {"subgroups per simd", quantity::occupancy},
    {"max waves", quantity::occupancy},
    {"max warps/sm", quantity::occupancy},
    {"spilled vgprs", quantity::spilled_vgprs},
    {"spilled sgprs", quantity::spilled_sgprs},
    {"spill count", quantity::spills},
    {"spills", quantity::spills},
    {"spills to memory", quantity::spills},
    {"fill count", quantity::fills},
    {"fills", quantity::fills},
    {"fills from memory", quantity::fills},
    {"scratch size", quantity::scratch},
    {"scratch", quantity::scratch},
    {"scratch memory size", quantity::scratch},
    {"slm size", quantity::scratch},
    {"stack size", quantity::scratch},
    {"local memory size", quantity::scratch},
    {"bytes stack frame", quantity::scratch},
    {"private memory", quantity::scratch},
    {"instructions", quantity::instructions},
    {"instruction count", quantity::instructions},
    {"inst", quantity::instructions},
    {"loop instructions", quantity::loop},
    {"latency", quantity::latency},
    {"cycles", quantity::latency},
    {"cycle count", quantity::latency},
    {"inverse throughput", quantity::throughput},
    {"vgprs", quantity::vgprs},
    {"sgprs", quantity::sgprs},
    {"number of gprs", quantity::registers},
    {"gprs", quantity::registers},
    {"register count", quantity::registers},
    {"registers", quantity::registers},
    {"max live registers", quantity::registers},
    {"code size", quantity::code_size},
    {"binary size", quantity::code_size},
    {"lds size", quantity::local},
    {"lds", quantity::local},
    {"local memory", quantity::local},
    {"shared memory size", quantity::local},
    {"branches", quantity::branches},
    {"loop branches", {"branches per iteration", "", false, true, 16}},
    {"copies", quantity::copies},
    {"pre-sched sgprs", {"SGPRs before scheduling", "", false, true, 20}},
}};

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  });
  return result;
}

bool counts_instructions(const record::Executable& executable) {
  return std::ranges::any_of(executable.statistics, [](const auto& each) {
    return code_statistic(each.first).rank == quantity::instructions.rank;
  });
}

void compare_executable(const std::string& name, const record::Executable& before,
                        const record::Executable& now, CodeComparison& comparison) {
  const bool counted = counts_instructions(before) && counts_instructions(now);
  const std::size_t first = comparison.changes.size();
  // `before` or `now` may lack a statistic that the other one contains. Because a missing statistic
  // is not zero, this is not a change.
  for (const auto& [statistic, value] : now.statistics) {
    const auto old = before.statistics.find(statistic);
    if (old == before.statistics.end() || old->second == value) continue;
    CodeStatistic meaning = code_statistic(statistic);
    // If `before` or `now` lacks the number of instructions, a change in the code size affects the
    // verdict instead.
    if (!counted && meaning.rank == quantity::code_size.rank) meaning.decides = true;
    comparison.changes.push_back({.executable = name,
                                  .driver_name = statistic,
                                  .statistic = meaning,
                                  .before = old->second,
                                  .now = value});
  }
  // If both executables report the number of instructions, but only the code size changed, then
  // only the encodings of the instructions or the waits between them differ. Such a change is
  // dropped, because the waits that LLVM inserts differ from run to run
  // (measure/code/compiled_code.cpp).
  const bool same_instructions =
      counted &&
      std::ranges::all_of(
          comparison.changes.begin() + static_cast<std::ptrdiff_t>(first), comparison.changes.end(),
          [](const CodeChange& each) { return each.statistic.rank == quantity::code_size.rank; });
  if (same_instructions) comparison.changes.resize(first);
  if (!before.assembly.empty() && !now.assembly.empty() && before.assembly != now.assembly) {
    comparison.reassembled.push_back(name);
  }
}

}  // namespace

CodeStatistic code_statistic(std::string_view driver_name) {
  const std::string name = lower(driver_name);
  const auto* const found = std::ranges::find(named_statistics, name, &NamedStatistic::driver_name);
  return found == named_statistics.end() ? CodeStatistic{} : found->statistic;
}

CodeDirection CodeComparison::direction() const {
  if (changes.empty()) return CodeDirection::same;
  const auto any = [&](auto is) { return std::ranges::any_of(changes, is); };
  const bool worse = any([](const CodeChange& each) { return each.worse(); });
  const bool better = any([](const CodeChange& each) { return each.better(); });
  if (!worse && !better) return CodeDirection::other;
  if (worse != better) return worse ? CodeDirection::worse : CodeDirection::better;
  const auto has_throughput = [&](bool worse_one) {
    return any([&](const CodeChange& each) {
      return each.statistic.rank == quantity::throughput.rank && each.worse() == worse_one;
    });
  };
  const bool faster = has_throughput(false) && !has_throughput(true);
  return faster ? CodeDirection::better : CodeDirection::worse;
}

bool CodeComparison::mixed() const {
  const auto any = [&](auto is) { return std::ranges::any_of(changes, is); };
  return any([](const CodeChange& each) { return each.worse(); }) &&
         any([](const CodeChange& each) { return each.better(); });
}

CodeComparison compare_code(const record::Code& before, const record::Code& now) {
  CodeComparison comparison;
  for (const auto& [name, executable] : now) {
    const auto old = before.find(name);
    if (old == before.end()) {
      comparison.added.push_back(name);
    } else {
      compare_executable(name, old->second, executable, comparison);
    }
  }
  for (const auto& [name, executable] : before) {
    if (!now.contains(name)) comparison.removed.push_back(name);
  }
  std::ranges::stable_sort(comparison.changes, {}, [](const CodeChange& each) {
    return std::tuple(std::string_view(each.executable), each.statistic.rank,
                      std::string_view(each.driver_name));
  });
  return comparison;
}

}  // namespace triptych::judge
