#pragma once
// Runs of a store as material for trials: one is taken out and judged, changed or not, by baselines
// that the ordinary accept made of the others.

#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::judge {

// A run of a plan with the anchors that were measured before it. Pictures and what drivers say of
// themselves are left out: only times and counters are judged.
struct PooledRun {
  std::string run;
  double percent = 0;  // planted in everything but anchors
  std::vector<record::Record> records;
  std::vector<record::Record> anchors;
  std::vector<record::Store::DeviceEntry> devices;
  // Of a planted one: the unplanted run with the fewest runs measured between, of two the earlier,
  // among those that no other of its size has: two launches made of one run share its slow minutes.
  // Where there are more planted runs than unplanted ones, some do.
  std::size_t beside = 0;
};

struct RunPool {
  std::string plan;
  std::vector<PooledRun> unplanted;
  std::vector<PooledRun> planted;
};

// By plan. Only runs that measured as much as the plan's most complete one, with nothing planted or
// one slowdown everywhere.
[[nodiscard]] std::vector<RunPool> pool_runs(const record::Store& store);

// One unplanted run with its anchors in a store of its own, where records can be exchanged for the
// time of a trial.
class TrialStore {
 public:
  // `number`: of the run in the pool, which must live as long. `file` must not be there, and stay.
  TrialStore(const RunPool& pool, std::size_t number, const std::filesystem::path& file);

  // Holds these records instead of those of the same plan, configuration and device until
  // restore().
  void exchange(const std::vector<record::Record>& changed);
  void restore();

  [[nodiscard]] Launch launch() const;

 private:
  void put(const std::vector<record::Record>& records);

  const PooledRun& run_;
  std::size_t number_;
  record::Store store_;
  std::set<std::tuple<std::string, std::string, std::string>> exchanged_;
};

// What the ordinary accept makes of all unplanted runs but those that are judged.
class TrialHistory {
 public:
  // Keeps its files in `folder`, which must be empty and stay. One unplanted run must be left.
  TrialHistory(const RunPool& pool, const std::set<std::size_t>& left_out,
               const std::filesystem::path& folder);

  // By the devices whose runs are stored: all, one, or all but one.
  [[nodiscard]] const Baselines& of(const std::set<std::string>& devices) const {
    return baselines_.at(devices);
  }

 private:
  std::map<std::set<std::string>, Baselines> baselines_;
};

// The ids of the devices in a pool.
[[nodiscard]] std::set<std::string> devices_of(const RunPool& pool);

}  // namespace triptych::judge
