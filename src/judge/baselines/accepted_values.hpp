#pragma once
// Writes the measurements of a run, except for images, to the baseline files.

#include <set>
#include <string>

#include "core/json.hpp"
#include "judge/baselines/accepted.hpp"
#include "judge/baselines/next_folder.hpp"

namespace triptych::judge {

// Removes all members of the object whose names are not in `kept`.
void keep_only(core::Json& object, const std::set<std::string>& kept);

// Writes lacking.json: the configurations that a driver version does not support, although another
// driver version for the same device does. `stored` is the manifest before this run. Call this
// function after the counters have been updated and the skipped configurations have been dropped.
void update_lacking(const Accepted& accepted, const Manifest& stored, NextFolder& next);

void update_values(const record::Store& store, const Accepted& accepted,
                   const AcceptRequest& request, NextFolder& next);

}  // namespace triptych::judge
