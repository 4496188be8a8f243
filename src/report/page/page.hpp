#pragma once
// The report: a self-contained HTML page with the verdict, the findings, the images of each scene
// next to the reference image, and sections about each plan. Sections without data are left out.

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
