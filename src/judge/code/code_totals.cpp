#include "judge/code/code_totals.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "judge/code/code_change.hpp"

namespace triptych::judge {
namespace {

std::string percent(double part, double whole) {
  return whole > 0 ? fmt::format("{:+.2f}%", 100 * part / whole) : "new";
}

std::string text_of(const std::string& name, const CodeTotal& total) {
  std::string text = fmt::format("{}: {:.0f} -> {:.0f} ({})", name, total.before, total.now,
                                 percent(total.now - total.before, total.before));
  if (total.less > 0 && total.more > 0) {
    text += fmt::format("; split: {}, {}", percent(-total.less, total.before),
                        percent(total.more, total.before));
  }
  return text;
}

}  // namespace

void CodeTotals::add(const std::string& configuration, const record::Code& before,
                     const record::Code& now) {
  struct Sum {
    double before = 0;
    double now = 0;
    bool more_is_worse = true;
  };
  std::map<std::string, Sum> sums;
  for (const auto& [name, executable] : now) {
    const auto old = before.find(name);
    if (old == before.end()) continue;
    for (const auto& [statistic, value] : executable.statistics) {
      const auto there = old->second.statistics.find(statistic);
      const CodeStatistic known = code_statistic(statistic);
      if (there == old->second.statistics.end() || known.mesa.empty()) continue;
      Sum& sum = sums[std::string(known.mesa)];
      sum.before += there->second;
      sum.now += value;
      sum.more_is_worse = known.more_is_worse;
    }
  }
  ++configurations_;
  bool changed = false;
  for (const auto& [name, sum] : sums) {
    CodeTotal& total = totals_[name];
    total.before += sum.before;
    total.now += sum.now;
    if (sum.now == sum.before) continue;
    changed = true;
    (sum.now > sum.before ? total.more : total.less) += sum.now > sum.before
                                                            ? sum.now - sum.before
                                                            : sum.before - sum.now;
    const bool worse = (sum.now > sum.before) == sum.more_is_worse;
    ++(worse ? total.hurt : total.helped);
    const double change = sum.before > 0 ? sum.now / sum.before : sum.now;
    const double badness = sum.more_is_worse ? change : (change > 0 ? 1 / change : sum.before);
    if (worse && badness > total.worst_change) {
      total.worst_change = badness;
      total.worst = fmt::format("{} ({:g} -> {:g})", configuration, sum.before, sum.now);
    }
  }
  if (changed) ++changed_;
}

std::vector<std::string> CodeTotals::lines() const {
  std::vector<std::string> lines;
  for (const auto& [name, total] : totals_) {
    if (total.helped + total.hurt == 0) continue;
    std::string line = fmt::format("{}; helped: {}, hurt: {}", text_of(name, total), total.helped,
                                   total.hurt);
    if (!total.worst.empty()) line += fmt::format("; worst: {}", total.worst);
    lines.push_back(std::move(line));
  }
  if (lines.empty()) {
    lines.push_back(fmt::format("no statistic changed in {} configurations", configurations_));
  }
  return lines;
}

std::string CodeTotals::line() const {
  std::vector<std::string> parts;
  for (const auto& [name, total] : totals_) {
    if (total.helped + total.hurt > 0) parts.push_back(text_of(name, total));
  }
  if (parts.empty()) return fmt::format("no statistic changed in {} configurations", configurations_);
  return fmt::format("{} of {} configurations changed: {}", changed_, configurations_,
                     fmt::join(parts, ", "));
}

}  // namespace triptych::judge
