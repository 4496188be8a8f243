#include "report/words/code.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <string_view>
#include <vector>

namespace triptych::report::words {
namespace {

using judge::CodeChange;

std::string change_text(const CodeChange& change) {
  const std::string_view name =
      change.statistic.name.empty() ? std::string_view(change.driver_name) : change.statistic.name;
  std::string text = fmt::format("{} {:g} → {:g}", name, change.before, change.now);
  if (change.before > 0 && change.statistic.has_relative_change()) {
    text += fmt::format(" ({:+.3g} %)", 100 * (change.now - change.before) / change.before);
  }
  return text;
}

// Lists the changes of one executable. If the occupancy changed, the changed register counts are
// written in parentheses after the occupancy, because they explain its change.
std::string executable_text(const std::vector<CodeChange>& changes) {
  std::vector<std::string> deciding;
  std::vector<std::string> others;
  std::vector<std::string> registers;
  for (const CodeChange& each : changes) {
    auto& list = each.statistic.decides              ? deciding
                 : each.statistic.counts_registers() ? registers
                                                     : others;
    list.push_back(change_text(each));
  }
  if (!deciding.empty() && changes.front().statistic.is_occupancy() && !registers.empty()) {
    deciding.front() += fmt::format(" ({})", fmt::join(registers, ", "));
    registers.clear();
  }
  deciding.insert(deciding.end(), registers.begin(), registers.end());
  if (!deciding.empty()) return fmt::format("{}", fmt::join(deciding, ", "));
  constexpr std::size_t max_others = 4;
  if (others.size() > max_others) {
    const std::size_t more = others.size() - max_others;
    others.resize(max_others);
    others.push_back(fmt::format("{} more", more));
  }
  return fmt::format("{}", fmt::join(others, ", "));
}

std::string share(double part, double whole) {
  return whole > 0 ? fmt::format("{:+.2f}%", 100 * part / whole) : "new";
}

}  // namespace

std::string text_of(const judge::CodeComparison& comparison) {
  std::map<std::string, std::vector<CodeChange>> executables;
  for (const CodeChange& each : comparison.changes) executables[each.executable].push_back(each);
  std::vector<std::string> parts;
  for (const auto& [name, changes] : executables) {
    parts.push_back(executables.size() == 1 && comparison.removed.empty()
                        ? executable_text(changes)
                        : fmt::format("{}: {}", name, executable_text(changes)));
  }
  if (!comparison.removed.empty()) {
    parts.push_back(fmt::format("no longer compiled: {}", fmt::join(comparison.removed, ", ")));
  }
  if (!comparison.added.empty()) {
    parts.push_back(fmt::format("newly compiled: {}", fmt::join(comparison.added, ", ")));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string text_of(const judge::CodeTotal& total) {
  std::string text = fmt::format("{:.0f} -> {:.0f} ({})", total.before, total.now,
                                 share(total.now - total.before, total.before));
  if (total.less > 0 && total.more > 0) {
    text += fmt::format("; decreases: {}, increases: {}", share(-total.less, total.before),
                        share(total.more, total.before));
  }
  text += fmt::format("; helped: {}, hurt: {}", total.helped, total.hurt);
  if (!total.worst.empty()) {
    text +=
        fmt::format("; worst: {} ({:g} -> {:g})", total.worst, total.worst_before, total.worst_now);
  }
  return text;
}

}  // namespace triptych::report::words
