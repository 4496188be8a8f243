#include "judge/code/code_totals.hpp"

#include "judge/code/code_change.hpp"

namespace triptych::judge {
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
      const auto old_value = old->second.statistics.find(statistic);
      const CodeStatistic meaning = code_statistic(statistic);
      if (old_value == old->second.statistics.end() || meaning.mesa_name.empty()) continue;
      Sum& sum = sums[std::string(meaning.mesa_name)];
      sum.before += old_value->second;
      sum.now += value;
      sum.more_is_worse = meaning.more_is_worse;
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
    (sum.now > sum.before ? total.more : total.less) +=
        sum.now > sum.before ? sum.now - sum.before : sum.before - sum.now;
    const bool worse = (sum.now > sum.before) == sum.more_is_worse;
    ++(worse ? total.hurt : total.helped);
    const double change = sum.before > 0 ? sum.now / sum.before : sum.now;
    const double badness = sum.more_is_worse ? change : (change > 0 ? 1 / change : sum.before);
    if (worse && badness > total.worst_change) {
      total.worst_change = badness;
      total.worst = configuration;
      total.worst_before = sum.before;
      total.worst_now = sum.now;
    }
  }
  if (changed) ++changed_;
}

}  // namespace triptych::judge
