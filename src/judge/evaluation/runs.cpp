#include "judge/evaluation/runs.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <set>

#include "judge/baselines/work.hpp"
#include "judge/correlation/model.hpp"
#include "judge/evaluation/judge.hpp"
#include "judge/statistics/statistics.hpp"
#include "judge/timing/anchor.hpp"

namespace triptych::judge {
namespace {

using record::Record;
using Level = std::pair<std::string, std::string>;

std::string api_of(const std::string& device) {
  return device.substr(0, device.find(':'));
}

std::vector<Record> chosen(const std::vector<Record>& records,
                           const std::function<bool(const Record&)>& choose) {
  std::vector<Record> result;
  std::ranges::copy_if(records, std::back_inserter(result),
                       [&](const Record& each) { return !is_anchor(each) && choose(each); });
  return result;
}

// All times of a record longer by a factor.
Record lengthened(Record record, double factor) {
  for (double& ns : record.wall_ns) ns *= factor;
  for (double& ns : record.device_ns) ns *= factor;
  return record;
}

// The same device's record of the same configuration; nullptr: there is none.
const Record* same_of(const Record& record, const std::vector<Record>& records) {
  const auto own = std::ranges::find_if(records, [&](const Record& each) {
    return each.device == record.device && each.configuration == record.configuration;
  });
  return own == records.end() ? nullptr : &*own;
}

// ln t of planted records over those without, in the median.
double cost_of(const std::vector<Record>& planted, const std::vector<Record>& unplanted) {
  std::vector<double> costs;
  for (const Record& record : planted) {
    const Record* own = same_of(record, unplanted);
    if (own == nullptr || own->time_ns_by(record.clock()).empty()) continue;
    costs.push_back(std::log(median(record.time_ns()) / median(own->time_ns_by(record.clock()))));
  }
  return costs.empty() ? 0 : median(costs);
}

// Counters of work as they were without what was planted, times a factor.
void set_work(Record& record, const std::vector<Record>& unplanted, double factor) {
  const Record* own = same_of(record, unplanted);
  if (own == nullptr) return;
  record.counters = own->counters;
  for (const std::string_view unit : work_units) {
    const auto counter = record.counters.find(std::string(unit));
    if (counter == record.counters.end()) continue;
    counter->second =
        static_cast<std::uint64_t>(std::llround(factor * static_cast<double>(counter->second)));
  }
}

// The records of a planted run that are planted in a trial.
using Planted = std::function<std::vector<Record>(const PooledRun&)>;

class Trials {
 public:
  Trials(const RunPool& pool, const RunTrials& options, const std::filesystem::path& folder)
      : pool_(pool),
        options_(options),
        random_(options.seed),
        judge_(pool, checks_of(options), folder),
        devices_(judge_.devices()) {
    for (const PooledRun& run : pool.planted) sizes_.insert(run.percent);
    find_levels();
  }

  Tallies run() && {
    for (std::size_t base = 0; base < pool_.unplanted.size(); ++base) try_unplanted(base);
    for (const double size : sizes_) {
      std::vector<const PooledRun*> runs;
      for (const PooledRun& run : pool_.planted) {
        if (run.percent == size) runs.push_back(&run);
      }
      for (const PooledRun* run : runs) try_everything(*run);
      for (const std::string& device : devices_) {
        try_configurations(runs, device);
        try_levels(runs, device);
      }
    }
    return std::move(judge_).tallies();
  }

 private:
  [[nodiscard]] static std::set<Check> checks_of(const RunTrials& options) {
    std::set<Check> checks;
    if (options.history) checks.insert(Check::timing);
    if (options.correlation) checks.insert(Check::correlation);
    return checks;
  }

  // Levels that the correlation judges, one name for several with the same configurations.
  void find_levels() {
    std::map<Level, std::set<std::string>> levels;
    std::set<std::string> all;
    for (const Record& record : pool_.unplanted.front().records) {
      if (is_anchor(record)) continue;
      all.insert(record.configuration);
      for (const auto& level : record.factors) levels[level].insert(record.configuration);
    }
    std::set<std::set<std::string>> seen;
    constexpr std::size_t least = CorrelationModel::least_level;
    for (const auto& [level, inside] : levels) {
      const bool judged = inside.size() >= least && all.size() >= inside.size() + least;
      if (judged && seen.insert(inside).second) levels_.push_back(level);
    }
    configurations_.assign(all.begin(), all.end());
  }

  // The run measured next; after the last, the one before it.
  [[nodiscard]] std::size_t neighbour(std::size_t run) const {
    return run + 1 < pool_.unplanted.size() ? run + 1 : run - 1;
  }

  // Likewise among planted runs of one size; nullptr where there is but one.
  [[nodiscard]] const PooledRun* neighbour(const PooledRun& run) const {
    const PooledRun* before = nullptr;
    bool passed = false;
    for (const PooledRun& other : pool_.planted) {
      if (other.percent != run.percent) continue;
      if (passed) return &other;
      passed = &other == &run;
      if (!passed) before = &other;
    }
    return before;
  }

  void try_unplanted(std::size_t base) {
    const std::size_t next = neighbour(base);
    judge_.judge({.spread = Spread::none}, {base, {}}, Attempt{next, {}}, {});
    judge_.judge_twice(base);
    for (const double size : sizes_) {
      judge_.judge({.spread = Spread::device, .percent = size}, slower_device(base, size),
                   slower_device(next, size), {});
    }
    if (!options_.correlation) return;
    for (const std::string& device : devices_) {
      judge_.judge({.spread = Spread::scrambled}, {base, scrambled(pool_.unplanted[base], device)},
                   std::nullopt, {device});
    }
  }

  [[nodiscard]] Attempt slower_device(std::size_t number, double percent) const {
    const PooledRun& run = pool_.unplanted[number];
    Attempt slower{number, {}};
    for (const auto* records : {&run.records, &run.anchors}) {
      for (const Record& each : *records) {
        slower.changed.push_back(lengthened(each, 1 + percent / 100));
      }
    }
    return slower;
  }

  [[nodiscard]] std::vector<Record> scrambled(const PooledRun& run, const std::string& device) {
    const std::vector<Record> own =
        chosen(run.records, [&](const Record& each) { return each.device == device; });
    std::vector<Record> result = own;
    const std::vector<std::size_t> order = shuffled(own.size(), random_);
    for (std::size_t i = 0; i < own.size(); ++i) {
      result[i].wall_ns = own[order[i]].wall_ns;
      result[i].device_ns = own[order[i]].device_ns;
      result[i].device_clock_trusted = own[order[i]].device_clock_trusted;
    }
    return result;
  }

  // The trials with `planted` of each run's records in the unplanted run that was measured next
  // to it; the second run is made of another planted one in the same way.
  void try_planted(const PooledRun& run, Trial trial, const Planted& planted,
                   const std::vector<std::string>& devices) {
    const Attempt first{run.beside, planted(run)};
    trial.percent = run.percent;
    trial.planted = names_of(chosen(first.changed, [](const Record&) { return true; }));
    if (trial.planted.empty()) return;
    std::optional<Attempt> second;
    if (const PooledRun* other = neighbour(run)) {
      second = {other->beside, planted(*other)};
      trial.cost_again = cost_in(*other, second->changed);
    }
    judge_.judge(trial, first, second, devices);
  }

  [[nodiscard]] double cost_in(const PooledRun& run, const std::vector<Record>& planted) const {
    return cost_of(planted, pool_.unplanted[run.beside].records);
  }

  // With its own anchors: it is a whole run.
  void try_everything(const PooledRun& run) {
    std::set<std::string> apis;
    for (const std::string& device : devices_) apis.insert(api_of(device));
    const auto planted = [&](Spread spread, const std::function<bool(const std::string&)>& where) {
      const auto on_devices = [&](const Record& each) { return where(each.device); };
      std::vector<std::string> devices;
      std::ranges::copy_if(devices_, std::back_inserter(devices), where);
      try_planted(
          run, {.spread = spread, .cost = cost_in(run, chosen(run.records, on_devices))},
          [&](const PooledRun& each) {
            std::vector<Record> changed = chosen(each.records, on_devices);
            changed.insert(changed.end(), each.anchors.begin(), each.anchors.end());
            return changed;
          },
          devices);
    };
    planted(Spread::global, [](const std::string&) { return true; });
    for (const std::string& api : apis) {
      planted(Spread::api, [&](const std::string& device) { return api_of(device) == api; });
    }
  }

  // Calls `one` for pairs of a planted run and one of `count` things, in random order, no pair
  // twice.
  void for_some(const std::vector<const PooledRun*>& runs, std::size_t count,
                const std::function<void(const PooledRun&, std::size_t, std::size_t)>& one) {
    const std::vector<std::size_t> order = shuffled(runs.size() * count, random_);
    for (std::size_t i = 0; i < std::min(order.size(), options_.most); ++i) {
      one(*runs[order[i] / count], order[i] % count, i);
    }
  }

  void try_configurations(const std::vector<const PooledRun*>& runs, const std::string& device) {
    for_some(runs, configurations_.size(),
             [&](const PooledRun& run, std::size_t which, std::size_t number) {
               const bool more_work = number % 2 == 1;
               const auto own = [&](const PooledRun& each) {
                 return chosen(each.records, [&](const Record& record) {
                   return record.device == device && record.configuration == configurations_[which];
                 });
               };
               try_planted(run,
                           {.spread = Spread::configuration,
                            .cost = cost_in(run, own(run)),
                            .more_work = more_work},
                           [&](const PooledRun& each) {
                             std::vector<Record> changed = own(each);
                             const double factor = more_work ? std::exp(cost_in(each, changed)) : 1;
                             for (Record& record : changed) {
                               set_work(record, pool_.unplanted[each.beside].records, factor);
                             }
                             return changed;
                           },
                           {device});
             });
  }

  void try_levels(const std::vector<const PooledRun*>& runs, const std::string& device) {
    for_some(runs, levels_.size(), [&](const PooledRun& run, std::size_t which, std::size_t) {
      const Level& level = levels_[which];
      const auto own = [&](const PooledRun& each) {
        return chosen(each.records, [&](const Record& record) {
          const auto found = record.factors.find(level.first);
          return record.device == device && found != record.factors.end() &&
                 found->second == level.second;
        });
      };
      try_planted(run, {.spread = Spread::level, .level = level, .cost = cost_in(run, own(run))},
                  own, {device});
    });
  }

  const RunPool& pool_;
  const RunTrials& options_;
  core::Random random_;
  TrialJudge judge_;
  const std::vector<std::string>& devices_;
  std::set<double> sizes_;
  std::vector<std::string> configurations_;
  std::vector<Level> levels_;
};

}  // namespace

Tallies evaluate_runs(const RunPool& pool, const RunTrials& trials,
                      const std::filesystem::path& folder) {
  if (pool.unplanted.size() < 2 || !(trials.history || trials.correlation)) return {};
  return Trials(pool, trials, folder).run();
}

}  // namespace triptych::judge
