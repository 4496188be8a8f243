#pragma once
#include "measure/plan/plan.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// Returns a run of the plan that begins now and has a new id. `program` is RunOptions::program.
[[nodiscard]] record::Run new_run(const Plan& plan, const std::string& program);

}  // namespace triptych::measure
