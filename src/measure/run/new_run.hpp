#pragma once
#include "measure/plan/plan.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// A run of the plan that begins now, with an id of its own.
[[nodiscard]] record::Run new_run(const Plan& plan);

}  // namespace triptych::measure
