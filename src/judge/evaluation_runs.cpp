#include "judge/evaluation_runs.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <set>

#include "core/json.hpp"
#include "judge/anchor.hpp"
#include "judge/correlation_pairs.hpp"
#include "judge/evaluation_counting.hpp"
#include "judge/statistics.hpp"

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

class Trials {
 public:
  Trials(const RunPool& pool, const RunTrials& options, const std::filesystem::path& folder)
      : pool_(pool), options_(options), folder_(folder), random_(options.seed) {
    if (options.history) checks_.insert(Check::timing);
    if (options.correlation) checks_.insert(Check::correlation);
    for (const PooledRun& run : pool.planted) sizes_.insert(run.percent);
    for (const auto& entry : pool.unplanted.front().devices) devices_.push_back(entry.device.id);
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
    return std::move(tallies_);
  }

 private:
  [[nodiscard]] TrialBench& bench(std::size_t base) {
    auto& known = benches_[base];
    if (!known) {
      const auto folder = folder_ / std::to_string(base);
      std::filesystem::create_directories(folder);
      known = std::make_unique<TrialBench>(pool_, base, folder);
    }
    return *known;
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

  // The gates of one trial: by all devices' baselines and, for a device that is not known yet, by
  // each other one's alone.
  void judge(std::size_t base, const Trial& trial, const std::vector<Record>& changed,
             const std::vector<std::string>& devices) {
    const std::vector<std::string>& judged = devices.empty() ? devices_ : devices;
    TrialBench& on = bench(base);
    for (const GateResult& result : on.judge(changed, {""}, checks_, devices)) {
      if (options_.history) count_history(pool_.plan, result, trial, judged, tallies_);
      count_correlations(pool_.plan, "correlation, accepted device", result, trial, tallies_);
    }
    if (!options_.correlation) return;
    std::set<std::string> others(devices_.begin(), devices_.end());
    if (judged.size() == 1) others.erase(judged.front());
    if (judged.size() == 1 && others.empty()) return;
    for (const GateResult& result : on.judge(changed, others, {Check::correlation}, devices)) {
      count_correlations(pool_.plan, "correlation, new device", result, trial, tallies_);
    }
  }

  void try_unplanted(std::size_t base) {
    judge(base, {.spread = Spread::none}, {}, {});
    ask_again(base);
    if (options_.history) count_seconds(pool_.unplanted[base]);
    const PooledRun& run = pool_.unplanted[base];
    for (const double size : sizes_) {
      std::vector<Record> slower;
      for (const auto* records : {&run.records, &run.anchors}) {
        for (const Record& each : *records) slower.push_back(lengthened(each, 1 + size / 100));
      }
      judge(base, {.spread = Spread::device, .percent = size}, slower, {});
    }
    if (!options_.correlation) return;
    for (const std::string& device : devices_) {
      judge(base, {.spread = Spread::scrambled}, scrambled(run, device), {device});
    }
  }

  // All that the protocol does of a configuration.
  void count_seconds(const PooledRun& run) {
    for (const Record& each : run.records) {
      double ns = each.loop_wall_ns + each.prepare_ns + each.overhead_ns;
      for (const double frame_ns : each.wall_ns) ns += frame_ns;
      tallies_[{"history", pool_.plan, each.device}].seconds += 1e-9 * ns;
    }
  }

  void ask_again(std::size_t base) {
    const auto verdict = [&] { return to_json(bench(base).judge({}, {""}, checks_, {}).at(0)); };
    tallies_[{"gate", pool_.plan, "all devices"}].same_bytes.count(verdict().dump() ==
                                                                   verdict().dump());
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

  // With its own anchors: it is a whole run.
  void try_everything(const PooledRun& run) {
    std::set<std::string> apis;
    for (const std::string& device : devices_) apis.insert(api_of(device));
    const auto planted = [&](Spread spread, const std::function<bool(const Record&)>& where) {
      std::vector<Record> changed = chosen(run.records, where);
      const Trial trial{.spread = spread,
                        .percent = run.percent,
                        .planted = names_of(changed),
                        .cost = cost_of(changed, pool_.unplanted[run.before].records)};
      std::vector<std::string> devices;
      for (const std::string& device : devices_) {
        const bool there =
            std::ranges::any_of(changed, [&](const Record& each) { return each.device == device; });
        if (there) devices.push_back(device);
      }
      if (devices.empty()) return;
      changed.insert(changed.end(), run.anchors.begin(), run.anchors.end());
      judge(run.before, trial, changed, devices);
    };
    planted(Spread::global, [](const Record&) { return true; });
    for (const std::string& api : apis) {
      planted(Spread::api, [&](const Record& each) { return api_of(each.device) == api; });
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
               std::vector<Record> changed = chosen(run.records, [&](const Record& each) {
                 return each.device == device && each.configuration == configurations_[which];
               });
               if (changed.empty()) return;
               const bool more_work = number % 2 == 1;
               const std::vector<Record>& without = pool_.unplanted[run.before].records;
               const double cost = cost_of(changed, without);
               set_work(changed.front(), without, more_work ? std::exp(cost) : 1);
               judge(run.before,
                     {.spread = Spread::configuration,
                      .percent = run.percent,
                      .planted = names_of(changed),
                      .level = {},
                      .cost = cost,
                      .more_work = more_work},
                     changed, {device});
             });
  }

  void try_levels(const std::vector<const PooledRun*>& runs, const std::string& device) {
    for_some(runs, levels_.size(), [&](const PooledRun& run, std::size_t which, std::size_t) {
      const Level& level = levels_[which];
      const std::vector<Record> changed = chosen(run.records, [&](const Record& each) {
        const auto found = each.factors.find(level.first);
        return each.device == device && found != each.factors.end() &&
               found->second == level.second;
      });
      if (changed.empty()) return;
      judge(run.before,
            {.spread = Spread::level,
             .percent = run.percent,
             .planted = names_of(changed),
             .level = level,
             .cost = cost_of(changed, pool_.unplanted[run.before].records)},
            changed, {device});
    });
  }

  const RunPool& pool_;
  const RunTrials& options_;
  const std::filesystem::path& folder_;
  core::Random random_;
  std::set<Check> checks_;
  std::set<double> sizes_;
  std::vector<std::string> devices_;
  std::vector<std::string> configurations_;
  std::vector<Level> levels_;
  std::map<std::size_t, std::unique_ptr<TrialBench>> benches_;
  Tallies tallies_;
};

}  // namespace

Tallies evaluate_runs(const RunPool& pool, const RunTrials& trials,
                      const std::filesystem::path& folder) {
  if (pool.unplanted.size() < 2 || !(trials.history || trials.correlation)) return {};
  return Trials(pool, trials, folder).run();
}

}  // namespace triptych::judge
