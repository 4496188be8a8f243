#pragma once
#include "measure/plan/plan.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// Returns a run of the plan with a new id, which starts now. `program` is RunOptions::program.
[[nodiscard]] record::Run new_run(const Plan& plan, const std::string& program);

}  // namespace triptych::measure
