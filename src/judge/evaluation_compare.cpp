#include "judge/evaluation_compare.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "judge/statistics.hpp"

namespace triptych::judge {
namespace {

using Launches = std::vector<const BlockSeries*>;

// All that was measured of one configuration.
struct Measured {
  std::map<std::string, std::string> factors;
  std::map<double, Launches> by_percent;
};
using Family = std::map<std::string, Measured>;  // by configuration

// How one configuration fares in a trial.
struct Entry {
  double percent = 0;
  PairVerdict verdict = PairVerdict::undecided;
  std::size_t blocks = 0;
  std::vector<double> launches;
  double cost = 0;  // of what was planted, in the first launch
  double seconds = 0;
};

double seconds_of(const BlockSeries& series, std::size_t blocks) {
  return series.seconds * static_cast<double>(blocks) /
         static_cast<double>(std::max<std::size_t>(series.differences.size(), 1));
}

void look(const BlockSeries& series, const ReplayDesign& design, Entry& entry) {
  for (const int blocks : design.looks.looks) {
    const auto count = static_cast<std::size_t>(blocks);
    if (count > series.differences.size()) break;
    entry.blocks = count;
    entry.verdict = look_at(std::span(series.differences).first(count), design.looks).verdict;
    if (entry.verdict != PairVerdict::undecided) break;
  }
  entry.cost = median(series.differences);
  entry.seconds += seconds_of(series, entry.blocks);
}

bool is_suspect(const Entry& entry) {
  return entry.verdict == PairVerdict::slower || entry.verdict == PairVerdict::faster;
}

void launch_again(const BlockSeries& series, const ReplayDesign& design, Entry& entry) {
  const std::size_t blocks = std::min(design.blocks_per_launch, series.differences.size());
  const auto first = std::span(series.differences).first(blocks);
  entry.launches.push_back(estimate_shift(first, design.looks.alpha_of_a_look()).estimate);
  entry.seconds += seconds_of(series, blocks);
}

void confirm_suspects(std::vector<Entry>& entries, const ReplayDesign& design) {
  std::vector<Suspect> suspects;
  std::vector<Entry*> suspected;
  for (Entry& entry : entries) {
    if (!is_suspect(entry)) continue;
    if (entry.launches.size() < 2) {
      entry.verdict = PairVerdict::undecided;
      continue;
    }
    suspects.push_back({entry.launches, entry.verdict == PairVerdict::slower});
    suspected.push_back(&entry);
  }
  const auto confirmed =
      confirm(suspects, entries.size(), design.false_discovery_rate, design.looks);
  for (std::size_t i = 0; i < suspected.size(); ++i) suspected[i]->verdict = confirmed[i].verdict;
}

void count(const std::vector<Entry>& entries, Tally& tally) {
  bool detected = false;
  bool alarmed = false;
  bool planted = false;
  std::vector<double> costs;
  for (const Entry& entry : entries) {
    if (entry.percent > 0) costs.push_back(entry.cost);
    const bool slower = entry.verdict == PairVerdict::slower;
    planted = planted || entry.percent > 0;
    if (entry.percent > 0) tally.found.count(slower);
    if (slower) tally.false_discoveries.count(entry.percent == 0);
    detected = detected || (slower && entry.percent > 0);
    alarmed = alarmed || (slower && entry.percent == 0);
    tally.undecided.count(entry.verdict == PairVerdict::undecided);
    tally.seconds += entry.seconds;
    ++tally.configurations;
  }
  if (planted) {
    tally.detected.count(detected);
    tally.costs.push_back(median(costs));
  }
  tally.false_alarms.count(alarmed);
}

class Replay {
 public:
  Replay(const Family& family, const ReplayDesign& design, std::uint64_t seed)
      : family_(family), design_(design), random_(seed) {
    std::map<std::pair<std::string, std::string>, std::set<std::string>> levels;
    for (const auto& [configuration, measured] : family) {
      configurations_.insert(configuration);
      for (const auto& level : measured.factors) levels[level].insert(configuration);
    }
    for (const auto& [level, inside] : levels) {
      if (inside.size() > 1 && inside.size() < family.size()) levels_.push_back(inside);
    }
  }

  // Nothing where that much was not planted in every configuration that is to have it.
  void trials(TrialKind kind, std::size_t number, Tallies& tallies) {
    for (std::size_t i = 0; i < number; ++i) {
      const auto planted = choose(kind.spread);
      if (!planted) return;
      if (auto entries = run(*planted, kind.percent)) count(*entries, tallies[kind]);
    }
  }

 private:
  template <typename Set>
  [[nodiscard]] const typename Set::value_type& any_of(const Set& set) {
    const double at = random_.uniform() * static_cast<double>(set.size());
    return *std::next(set.begin(), static_cast<std::ptrdiff_t>(at));
  }

  [[nodiscard]] std::optional<std::set<std::string>> choose(Spread spread) {
    if (spread == Spread::global) return configurations_;
    if (spread == Spread::configuration) return std::set<std::string>{any_of(configurations_)};
    if (spread != Spread::level) return std::set<std::string>{};
    if (levels_.empty()) return std::nullopt;
    return any_of(levels_);
  }

  [[nodiscard]] std::optional<std::vector<Entry>> run(const std::set<std::string>& planted,
                                                      double percent) {
    std::vector<Entry> entries;
    for (const auto& [configuration, measured] : family_) {
      Entry entry{.percent = planted.contains(configuration) ? percent : 0};
      const auto found = measured.by_percent.find(entry.percent);
      if (found == measured.by_percent.end()) return std::nullopt;
      const Launches& launches = found->second;
      const std::vector<std::size_t> order = shuffled(launches.size(), random_);
      look(*launches[order[0]], design_, entry);
      const std::size_t last = std::min(order.size(), design_.launches + 1);
      for (std::size_t i = 1; i < last && is_suspect(entry); ++i) {
        launch_again(*launches[order[i]], design_, entry);
      }
      entries.push_back(std::move(entry));
    }
    confirm_suspects(entries, design_);
    return entries;
  }

  const Family& family_;
  const ReplayDesign& design_;
  core::Random random_;
  std::set<std::string> configurations_;
  std::vector<std::set<std::string>> levels_;  // configurations of each
};

}  // namespace

Tallies evaluate_comparison(std::span<const BlockSeries> series, std::size_t trials,
                            std::uint64_t seed, const ReplayDesign& design) {
  std::map<std::pair<std::string, std::string>, Family> families;  // by plan and device
  std::set<double> sizes;
  for (const BlockSeries& each : series) {
    Measured& measured = families[{each.plan, each.device}][each.configuration];
    measured.factors = each.factors;
    measured.by_percent[each.percent].push_back(&each);
    if (each.percent > 0) sizes.insert(each.percent);
  }
  Tallies tallies;
  for (const auto& [name, family] : families) {
    Replay replay(family, design, seed);
    TrialKind kind{"compare", name.first, name.second};
    replay.trials(kind, trials, tallies);
    for (const Spread spread : {Spread::configuration, Spread::level, Spread::global}) {
      kind.spread = spread;
      for (const double percent : sizes) {
        kind.percent = percent;
        replay.trials(kind, trials, tallies);
      }
    }
  }
  return tallies;
}

}  // namespace triptych::judge
