#include "judge/evaluation/compare.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "judge/statistics/statistics.hpp"

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
  double cost = 0;  // of what was planted, in ln t
  double seconds = 0;
};

// Over all launches of a configuration: one of them is by chance more or less.
double cost_of(const Launches& launches) {
  std::vector<double> costs;
  for (const BlockSeries* series : launches) costs.push_back(median(series->differences));
  return median(costs);
}

// The class of cost_classes.
double class_of(double cost) {
  const double percent = 100 * std::expm1(cost);
  const auto* const above = std::ranges::upper_bound(cost_classes, percent);
  return above == cost_classes.begin() ? cost_classes.front() : *std::prev(above);
}

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
  entry.seconds += seconds_of(series, entry.blocks);
}

bool is_suspect(const Entry& entry) {
  return entry.verdict == PairVerdict::slower || entry.verdict == PairVerdict::faster;
}

// A configuration's further launches, in the order in which they are taken.
struct Suspected {
  Entry* entry = nullptr;
  Launches left;
};

void confirm_suspects(std::span<const Suspected> suspected, const ReplayDesign& design) {
  std::vector<Suspect> suspects;
  for (const Suspected& each : suspected) {
    suspects.push_back({{}, each.entry->verdict == PairVerdict::slower});
  }
  const auto launch_again = [&](std::span<const std::size_t> open, std::size_t number,
                                std::size_t /*until*/) {
    bool any = false;
    for (const std::size_t i : open) {
      const Launches& left = suspected[i].left;
      if (number > left.size()) continue;
      any = true;
      const BlockSeries& series = *left[number - 1];
      const std::size_t blocks =
          std::min(design.confirmation.blocks_per_launch, series.differences.size());
      const auto first = std::span(series.differences).first(blocks);
      const double level = design.looks.alpha_of_a_look();
      suspects[i].launches.push_back(estimate_shift(first, level).estimate);
      suspected[i].entry->seconds += seconds_of(series, blocks);
    }
    return any;
  };
  const auto confirmed =
      confirm_in_looks(suspects, design.confirmation, design.looks, launch_again);
  for (std::size_t i = 0; i < suspected.size(); ++i) {
    suspected[i].entry->verdict = confirmed[i].verdict;
  }
}

void count_found(const Entry& entry, const SequentialDesign& design, Tally& tally) {
  const bool slower = entry.verdict == PairVerdict::slower;
  tally.found.count(slower);
  tally.found_by_cost[class_of(entry.cost)].count(slower);
  if (entry.cost >= design.caught) tally.to_be_caught.count(slower);
}

void count(const std::vector<Entry>& entries, const SequentialDesign& design, Tally& tally) {
  bool detected = false;
  bool alarmed = false;
  bool planted = false;
  std::vector<double> costs;
  for (const Entry& entry : entries) {
    if (entry.percent > 0) costs.push_back(entry.cost);
    const bool slower = entry.verdict == PairVerdict::slower;
    planted = planted || entry.percent > 0;
    if (entry.percent > 0) count_found(entry, design, tally);
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
      if (auto entries = run(*planted, kind.percent)) count(*entries, design_.looks, tallies[kind]);
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
    entries.reserve(family_.size());
    std::vector<Suspected> suspected;
    for (const auto& [configuration, measured] : family_) {
      Entry entry{.percent = planted.contains(configuration) ? percent : 0};
      const auto found = measured.by_percent.find(entry.percent);
      if (found == measured.by_percent.end()) return std::nullopt;
      const Launches& launches = found->second;
      if (entry.percent > 0) entry.cost = cost_of(launches);
      const std::vector<std::size_t> order = shuffled(launches.size(), random_);
      look(*launches[order[0]], design_, entry);
      entries.push_back(entry);
      if (!is_suspect(entry)) continue;
      suspected.push_back({.entry = &entries.back()});
      for (const std::size_t i : std::span(order).subspan(1)) {
        suspected.back().left.push_back(launches[i]);
      }
    }
    confirm_suspects(suspected, design_);
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
