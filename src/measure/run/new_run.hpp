#pragma once
#include "measure/plan/plan.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// Returns a new run of the plan, which has a new id and starts now. `program` is
// RunOptions::program.
[[nodiscard]] record::Run new_run(const Plan& plan, const std::string& program);

}  // namespace triptych::measure
