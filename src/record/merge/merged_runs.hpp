#pragma once
// Which runs and devices a merge has, and what may not be merged.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "record/store.hpp"

namespace triptych::record {

// A plan's run and the parts that it is made of.
struct MergedRun {
  Run run;
  std::vector<std::string> parts;           // id of the run in each store, empty where it has none
  std::vector<Store::DeviceEntry> devices;  // by id
  std::vector<std::string> planned;         // keys of configurations of any part, sorted
};

struct MergedRuns {
  std::vector<MergedRun> runs;  // by plan
  std::uint64_t older = 0;      // runs that are not the latest of their plan in a store
};

// Throws InputError as merge_stores().
[[nodiscard]] MergedRuns merged_runs(const std::vector<std::filesystem::path>& stores);

}  // namespace triptych::record
