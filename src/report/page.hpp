#pragma once
// One self-contained HTML page: the verdict, the devices, per scene the panels beside the truth,
// the time distributions, the counters. It prints nothing that was not measured.

#include <functional>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"
#include "record/store.hpp"

namespace triptych::report {

struct PlanReport {
  record::Run run;
  judge::GateResult verdict;
};

struct PageRequest {
  std::vector<PlanReport> plans;
  std::function<judge::TruthPair(const record::Record&)> truth;
};

[[nodiscard]] std::string page(const record::Store& store, const PageRequest& request);

}  // namespace triptych::report
