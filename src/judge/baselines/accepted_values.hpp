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

void update_values(const record::Store& store, const Accepted& accepted,
                   const AcceptRequest& request, NextFolder& next);

}  // namespace triptych::judge
