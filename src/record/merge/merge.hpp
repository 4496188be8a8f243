#pragma once
// Merges stores into one: shards of a plan, from several hosts and devices, become one run.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "record/merge/record_copy.hpp"
#include "record/store.hpp"

namespace triptych::record {

// The part of a plan that is missing in a store's latest run.
struct Gap {
  std::string plan;
  std::string device;  // empty: no run was begun
  std::uint64_t records = 0;
  // The number to be measured; 0 if the run had nothing to measure.
  std::uint64_t configurations = 0;
  std::vector<std::string> missing = {};  // the keys of the missing ones, if the run lists them
};
// A complete shard has none. A store whose shards are all empty has a gap for each plan.
[[nodiscard]] std::vector<Gap> gaps_of(const Store& store);

struct MergeResult {
  struct Plan {
    Run run;
    RecordCounts counts;
  };
  std::vector<Plan> plans;  // by name
  // Left out, because only the latest run of each plan in a store is merged.
  std::uint64_t older_runs = 0;
};

// Writes a store with one run for each plan. Its id and its start are the earliest of its parts',
// and its system facts are those of all parts. Of two records of one configuration and device, one
// without an injected fault is kept; then one that was measured; otherwise the one with the smaller
// seal. The same holds for the clocks of a device. The order of the stores makes no difference to a
// single byte, and neither does merging a store twice. The need for memory does not grow with the
// number of records or stores.
// `out` appears when everything is written; an existing file is refused. Throws InputError if
// stores have different texts or checks for a plan, a different device with the same id, or data
// with the same name and other content. Errors of reading and writing are those of Store.
[[nodiscard]] MergeResult merge_stores(const std::vector<std::filesystem::path>& stores,
                                       const std::filesystem::path& out,
                                       const RecordCopy::Tell& tell = {});

}  // namespace triptych::record
