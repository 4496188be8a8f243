#pragma once
// Runs of a store as material for trials: one is taken out and judged, changed or not, by baselines
// that the ordinary accept made of the others.

#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "judge/gate.hpp"

namespace triptych::judge {

// A run of a plan with the anchors that were measured before it. Pictures and what drivers say of
// themselves are left out: only times and counters are judged.
struct PooledRun {
  std::string run;
  double percent = 0;  // planted in everything but anchors
  std::vector<record::Record> records;
  std::vector<record::Record> anchors;
  std::vector<record::Store::DeviceEntry> devices;
  std::size_t before = 0;  // of a planted one: the unplanted run that was measured just before it
};

struct RunPool {
  std::string plan;
  std::vector<PooledRun> unplanted;
  std::vector<PooledRun> planted;
};

// By plan. Only runs that measured as much as the plan's most complete one, with nothing planted or
// one slowdown everywhere.
[[nodiscard]] std::vector<RunPool> pool_runs(const record::Store& store);

// One unplanted run with its anchors in a store of its own, where records can be exchanged.
class TrialStore {
 public:
  // `number`: of the run in the pool, which must live as long. `file` must not be there, and stay.
  TrialStore(const RunPool& pool, std::size_t number, const std::filesystem::path& file);

  // Judges the run with these records instead of those of the same plan, configuration and device.
  // `devices`: as in GateRequest.
  [[nodiscard]] GateResult judge(const std::vector<record::Record>& changed,
                                 const Baselines& baselines, const std::set<Check>& checks,
                                 const std::vector<std::string>& devices);

 private:
  void put(const std::vector<record::Record>& records);

  const PooledRun& run_;
  std::string plan_;
  std::size_t number_;
  record::Store store_;
};

// What the ordinary accept makes of all unplanted runs but one. Each is stored under the id that
// its TrialStore gives it, so that the gate does not take it for a witness about itself.
class TrialHistory {
 public:
  // Keeps its files in `folder`, which must be empty and stay. `pool` must have two unplanted runs.
  TrialHistory(const RunPool& pool, std::size_t left_out, const std::filesystem::path& folder);

  // By the device whose runs are stored, "" for all devices'.
  [[nodiscard]] const Baselines& of(const std::string& device) const {
    return baselines_.at(device);
  }

 private:
  std::map<std::string, Baselines> baselines_;
};

}  // namespace triptych::judge
