#pragma once
#include "measure/plan/plan.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// A run of the plan that begins now and gets a new id. `program` is that of RunOptions.
[[nodiscard]] record::Run new_run(const Plan& plan, const std::string& program);

}  // namespace triptych::measure
