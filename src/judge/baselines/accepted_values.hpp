#pragma once
// Writes what a run measured, apart from images, into the files of the baselines.

#include <set>
#include <string>

#include "core/json.hpp"
#include "judge/baselines/accepted.hpp"
#include "judge/baselines/next_folder.hpp"

namespace triptych::judge {

// Removes all other members.
void drop_all_but(core::Json& object, const std::set<std::string>& kept);

// Writes which configurations each driver version lacks that other versions of its device have.
// `stored` is the manifest before this run. Call it after the counters are updated and dropped.
void update_lacking(const Accepted& accepted, const Manifest& stored, NextFolder& next);

void update_values(const record::Store& store, const Accepted& accepted,
                   const AcceptRequest& request, NextFolder& next);

}  // namespace triptych::judge
