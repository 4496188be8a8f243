#pragma once
// The runs and devices of a merge, and the conditions under which stores must not be merged.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "record/store.hpp"

namespace triptych::record {

// The merged run of a plan, and the parts from which it is merged.
struct MergedRun {
  Run run;
  std::vector<std::string> parts;           // run id in each store; empty if the store has no run
  std::vector<Store::DeviceEntry> devices;  // sorted by id
  std::vector<std::string> planned;         // keys of the configurations of all parts, sorted
};

struct MergedRuns {
  std::vector<MergedRun> runs;  // sorted by plan
  std::uint64_t older = 0;  // number of runs that are not the latest run of their plan in a store
};

// Throws InputError in the same cases as merge_stores().
[[nodiscard]] MergedRuns merged_runs(const std::vector<std::filesystem::path>& stores);

}  // namespace triptych::record
