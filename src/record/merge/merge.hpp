#pragma once
// Stores into one: shards of a plan, from several hosts and devices, become one run of it.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "record/merge/record_copy.hpp"
#include "record/store.hpp"

namespace triptych::record {

// What a store's latest run of a plan has no record of yet.
struct Gap {
  std::string plan;
  std::string device;  // empty: none was begun
  std::uint64_t records = 0;
  std::uint64_t configurations = 0;  // that there are to be; 0: the run was to measure nothing
  std::vector<std::string> missing = {};  // their keys, where the run says which they are
};
// None in a shard that is complete. A store whose shards are all empty is a gap of each plan.
[[nodiscard]] std::vector<Gap> gaps_of(const Store& store);

struct MergeResult {
  struct Plan {
    Run run;
    RecordCounts counts;
  };
  std::vector<Plan> plans;       // by name
  std::uint64_t older_runs = 0;  // left out: of each plan a store gives its latest run
};

// Writes a store of one run for each plan: its id and start are the earliest of its parts', its
// system's facts are all of theirs. Of two records of one configuration and device one without
// an injected fault is kept, then one that was measured, else the one of the smaller seal; of a
// device's clocks likewise. Which stores are merged first, or twice, makes no difference to a byte.
// Memory does not grow with records, nor with stores.
//
// `out` appears when all is written; one that is there already is refused. Throws InputError where
// stores have different texts of a plan, or checks; a device that is another; or data of one name
// and another content. Errors of reading and writing are Store's.
[[nodiscard]] MergeResult merge_stores(const std::vector<std::filesystem::path>& stores,
                                       const std::filesystem::path& out,
                                       const RecordCopy::Tell& tell = {});

}  // namespace triptych::record
