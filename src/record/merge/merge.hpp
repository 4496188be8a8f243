#pragma once
// Merges several stores into one. The shards (parts) of a plan, which may have been measured on
// several hosts and devices, become one run.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "record/merge/record_copy.hpp"
#include "record/store.hpp"

namespace triptych::record {

// A plan, or one device of a plan, for which the latest run in a store is incomplete.
struct Gap {
  std::string plan;
  std::string device;  // empty if the gap affects the whole plan
  std::uint64_t records = 0;
  // The number of configurations that should have been measured; 0 if there were none.
  std::uint64_t configurations = 0;
  // The keys of the configurations without a record, if the run lists its configurations.
  std::vector<std::string> missing = {};
};
// Returns the gaps in a store. A complete shard has no gaps. If the shards of all plans in a store
// are empty, every plan counts as a gap.
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

// Writes a store with one run for each plan. A merged run has the smallest id and the earliest
// start time of its parts, and the system facts of all parts. If there are several records of the
// same configuration and device, only one of them is copied. Records without an injected fault are
// preferred, then measured records, then skipped records, and then the record with the smallest
// seal (a hash of its content). If a device's clocks were calibrated several times, the calibration
// with the smallest seal is kept. The new store is byte-identical regardless of the order of
// `stores`, even if a store is listed twice. Memory use does not grow with the number of records or
// stores.
//
// `out` appears only when everything has been written. An existing file is not overwritten. Throws
// InputError if two stores have different versions of a plan, different checks for the same plan,
// different devices with the same id, or different data with the same name. Also throws the
// exceptions that Store throws when a file cannot be read or written.
[[nodiscard]] MergeResult merge_stores(const std::vector<std::filesystem::path>& stores,
                                       const std::filesystem::path& out,
                                       const RecordCopy::OnProgress& on_progress = {});

}  // namespace triptych::record
