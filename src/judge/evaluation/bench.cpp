#include "judge/evaluation/bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "judge/timing/anchor.hpp"

namespace triptych::judge {
namespace {

// In the order of ids as in the pool, anchors before their run.
std::string run_id(std::size_t number) {
  return fmt::format("{:06}-run", number);
}

std::string anchors_id(std::size_t number) {
  return fmt::format("{:06}-anchors", number);
}

// The size of "slowdown:PERCENT", 0 for nothing planted; nullopt for any other fault.
std::optional<double> planted_percent(std::string_view planted) {
  constexpr std::string_view slowdown = "slowdown:";
  if (planted.empty()) return 0;
  if (!planted.starts_with(slowdown)) return std::nullopt;
  planted.remove_prefix(slowdown.size());
  double percent = 0;
  const auto [end, error] =
      std::from_chars(planted.data(), planted.data() + planted.size(), percent);
  if (error != std::errc() || end != planted.data() + planted.size()) return std::nullopt;
  return percent;
}

std::vector<record::Record> measured(const record::Store& store, const std::string& run) {
  std::vector<record::Record> result;
  for (record::Record& record : store.records(run)) {
    if (record.outcome != record::Outcome::measured || record.time_ns().empty()) continue;
    record.image.clear();
    record.scene = "none";  // baselines keep a picture of each, and a hash of its data
    record.data_hash.clear();
    record.statistics.clear();
    record.benchmark_json.clear();
    result.push_back(std::move(record));
  }
  return result;
}

// nullopt where not all has the same planted.
std::optional<double> planted_everywhere(const std::vector<record::Record>& records) {
  std::optional<double> percent;
  for (const record::Record& record : records) {
    const auto own = planted_percent(record.planted);
    if (!own || (percent && *percent != *own)) return std::nullopt;
    percent = own;
  }
  return percent;
}

void drop_incomplete(std::vector<PooledRun>& runs) {
  std::size_t most = 0;
  for (const PooledRun& run : runs) most = std::max(most, run.records.size());
  std::erase_if(runs, [most](const PooledRun& run) { return run.records.size() < most; });
}

// Of `places`, ascending, the index of the nearest to `place` that is not taken; of all, where all
// are.
std::size_t nearest(const std::vector<std::size_t>& places, std::size_t place,
                    const std::set<std::size_t>& taken) {
  const auto distance = [&](std::size_t i) {
    const std::size_t away = places[i] < place ? place - places[i] : places[i] - place;
    return std::pair(taken.size() < places.size() && taken.contains(i), away);
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (distance(i) < distance(best)) best = i;
  }
  return best;
}

void sort_out(const std::string& plan, std::vector<PooledRun> runs, std::vector<RunPool>& pools) {
  drop_incomplete(runs);
  RunPool pool{plan, {}, {}};
  std::vector<std::size_t> unplanted;
  std::map<double, std::set<std::size_t>> taken;  // by size
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].percent == 0) unplanted.push_back(i);
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].percent == 0) {
      pool.unplanted.push_back(std::move(runs[i]));
    } else {
      std::set<std::size_t>& of_size = taken[runs[i].percent];
      runs[i].beside = nearest(unplanted, i, of_size);
      of_size.insert(runs[i].beside);
      pool.planted.push_back(std::move(runs[i]));
    }
  }
  pools.push_back(std::move(pool));
}

// A copy of a run under an id of its own, of these devices.
void add_copy(const PooledRun& run, const std::string& plan, const std::string& id,
              const std::vector<record::Record>& records, const std::set<std::string>& devices,
              record::Store& store) {
  store.add_run({id, plan, "", {}});
  for (const auto& entry : run.devices) {
    if (devices.contains(entry.device.id)) store.add_device(id, entry.device, entry.clocks);
  }
  for (record::Record record : records) {
    if (!devices.contains(record.device)) continue;
    record.run = id;
    store.add_record(record);
  }
}

void accept_copy(const record::Store& store, const std::string& id, const std::string& plan,
                 const std::filesystem::path& root) {
  static_cast<void>(accept(store, id, root,
                           {.plan = plan,
                            .reason = "a trial's history",
                            .only = {},
                            .date = "1970-01-01",
                            .truth = [](const record::Record&) {
                              core::Image image;
                              image.width = image.height = 1;
                              image.rgba.assign(4, 0.0F);
                              return image;
                            }}));
}

}  // namespace

std::vector<RunPool> pool_runs(const record::Store& store) {
  std::vector<std::string> plans;
  std::map<std::string, std::vector<PooledRun>> by_plan;
  std::string anchors;
  for (const record::Run& run : store.runs()) {
    if (!run.confirms.empty()) continue;
    if (run.plan == anchors_plan) {
      anchors = run.id;
      continue;
    }
    PooledRun pooled{
        .run = run.id,
        .records = measured(store, run.id),
        .anchors = anchors.empty() ? std::vector<record::Record>{} : measured(store, anchors),
        .devices = store.devices(run.id)};
    const auto percent = planted_everywhere(pooled.records);
    if (!percent) continue;
    pooled.percent = *percent;
    if (!by_plan.contains(run.plan)) plans.push_back(run.plan);
    by_plan[run.plan].push_back(std::move(pooled));
  }
  std::vector<RunPool> pools;
  for (const std::string& plan : plans) sort_out(plan, std::move(by_plan.at(plan)), pools);
  return pools;
}

TrialStore::TrialStore(const RunPool& pool, std::size_t number, const std::filesystem::path& file)
    : run_(pool.unplanted.at(number)), number_(number), store_(file, record::Store::Mode::append) {
  const std::set<std::string> all = devices_of(pool);
  add_copy(run_, std::string(anchors_plan), anchors_id(number), run_.anchors, all, store_);
  add_copy(run_, pool.plan, run_id(number), run_.records, all, store_);
}

void TrialStore::put(const std::vector<record::Record>& records) {
  for (record::Record record : records) {
    record.run = record.plan == anchors_plan ? anchors_id(number_) : run_id(number_);
    store_.add_record(record);
  }
}

void TrialStore::exchange(const std::vector<record::Record>& changed) {
  put(changed);
  for (const auto& each : changed) {
    exchanged_.emplace(each.plan, each.configuration, each.device);
  }
}

void TrialStore::restore() {
  std::vector<record::Record> original;
  for (const auto* records : {&run_.records, &run_.anchors}) {
    std::ranges::copy_if(*records, std::back_inserter(original), [&](const record::Record& each) {
      return exchanged_.contains({each.plan, each.configuration, each.device});
    });
  }
  put(original);
  exchanged_.clear();
}

Launch TrialStore::launch() const {
  return {&store_, run_id(number_)};
}

TrialHistory::TrialHistory(const RunPool& pool, const std::set<std::size_t>& left_out,
                           const std::filesystem::path& folder) {
  const std::set<std::string> all = devices_of(pool);
  std::set<std::set<std::string>> known{all};
  for (const std::string& device : all) {
    known.insert({device});
    std::set<std::string> others = all;
    others.erase(device);
    if (!others.empty()) known.insert(others);
  }
  for (const std::set<std::string>& devices : known) {
    const std::string name = std::to_string(baselines_.size());
    const std::filesystem::path root = folder / name;
    record::Store history(folder / (name + ".sqlite"), record::Store::Mode::append);
    for (std::size_t i = 0; i < pool.unplanted.size(); ++i) {
      if (left_out.contains(i)) continue;
      const PooledRun& run = pool.unplanted[i];
      add_copy(run, pool.plan, run_id(i), run.records, devices, history);
      accept_copy(history, run_id(i), pool.plan, root);
      if (run.anchors.empty()) continue;
      add_copy(run, std::string(anchors_plan), anchors_id(i), run.anchors, devices, history);
      accept_copy(history, anchors_id(i), std::string(anchors_plan), root);
    }
    baselines_.emplace(devices, Baselines(root, pool.plan));
  }
}

std::set<std::string> devices_of(const RunPool& pool) {
  std::set<std::string> devices;
  for (const auto& entry : pool.unplanted.front().devices) devices.insert(entry.device.id);
  return devices;
}

}  // namespace triptych::judge
