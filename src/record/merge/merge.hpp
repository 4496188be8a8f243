#pragma once
// Merges several stores into one: the shards of a plan, from several hosts and devices, become one
// run.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "record/merge/record_copy.hpp"
#include "record/store.hpp"

namespace triptych::record {

// A plan, or a device of it, for which a store's latest run is incomplete.
struct Gap {
  std::string plan;
  std::string device;  // empty if no run was begun
  std::uint64_t records = 0;
  // The number of configurations to be measured; 0 if the run had nothing to measure.
  std::uint64_t configurations = 0;
  std::vector<std::string> missing = {};  // the keys of these, if the run lists them
};
// A complete shard has no gaps. A store whose shards are all empty has a gap for each plan.
[[nodiscard]] std::vector<Gap> gaps_of(const Store& store);

struct MergeResult {
  struct Plan {
    Run run;
    RecordCounts counts;
  };
  std::vector<Plan> plans;  // sorted by name
  // The number of runs that were left out, because only the latest run of each plan in a store is
  // merged.
  std::uint64_t older_runs = 0;
};

// Writes a store with one run for each plan. The run has the earliest id and start of its parts,
// and the system facts of all parts. If there are two records of the same configuration and device,
// the one without an injected fault is kept; if that does not decide, the one that was measured;
// otherwise the one with the smaller seal. Of two calibrations of a device's clocks, the one with
// the smaller seal is kept. The result is the same to the byte whatever the order of the stores is,
// and also if a store is merged twice. The memory that is needed does not grow with the number of
// records or stores.
//
// `out` appears only when everything has been written; an existing file is not overwritten. Throws
// InputError if two stores have different texts or checks for the same plan, different devices with
// the same id, or different data with the same name. Errors in reading and writing are those of
// Store.
[[nodiscard]] MergeResult merge_stores(const std::vector<std::filesystem::path>& stores,
                                       const std::filesystem::path& out,
                                       const RecordCopy::Tell& tell = {});

}  // namespace triptych::record
