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

class TrialBench {
 public:
  // Keeps its files in `folder`, which must be empty and stay. `pool` must have two unplanted runs
  // and live as long.
  TrialBench(const RunPool& pool, std::size_t base, const std::filesystem::path& folder);

  // Judges the run with these records instead of those of the same plan, configuration and device.
  // One result for each of `known`: the device whose stored runs judge, "" for all devices'.
  // `devices`: as in GateRequest.
  [[nodiscard]] std::vector<GateResult> judge(const std::vector<record::Record>& changed,
                                              const std::set<std::string>& known,
                                              const std::set<Check>& checks,
                                              const std::vector<std::string>& devices);

 private:
  void put(const std::vector<record::Record>& records);

  const PooledRun& base_;
  std::string plan_;
  record::Store store_;
  std::map<std::string, Baselines> baselines_;  // by the device that they hold, "" for all
};

}  // namespace triptych::judge
