#pragma once
// Implements the search of `--error E`: finds the configurations that meet a requested error and
// may be the fastest.

#include <functional>
#include <vector>

#include "core/image.hpp"
#include "measure/plan/plan.hpp"
#include "measure/request/error_goal.hpp"
#include "measure/request/error_progress.hpp"
#include "measure/truth/truths.hpp"
#include "record/record.hpp"

namespace triptych::measure {

struct ErrorRequest {
  Plan plan;  // contains the candidates for all scenes in which the error can be met
  std::vector<Unreachable> unreachable;
};

// Draws each configuration of the plan on every device, without measuring times, and calls `use`
// for each record that has an image.
using UseTrial = std::function<void(const record::Record&, const core::Image&)>;
using DrawTrials = std::function<void(const Plan&, const UseTrial& use)>;

struct ErrorSearch {
  SuiteWithTruth& suite;
  const ErrorGoal& goal;
  Truths& truths;
  DrawTrials draw;
  std::function<void(const ErrorProgress&)> report;
};

// Chooses the levels of the error_factors that are not fixed. The plan's levels of the other
// error_factors are ignored.
//
// For each scene of the plan and each quadrature, the search begins with the longest step with
// which the error of a small reference image (accuracy::search_size()) is at most
// accuracy::step_share of the requested error, and with a threshold of early ray termination that
// can cause at most accuracy::termination_share of it. All devices then draw complete images with
// these settings, and with longer steps and larger thresholds, as long as the measured error of the
// image permits (accuracy::BudgetSearch). For each device, the settings with the fewest samples
// become candidates: one for every skipping mode. If samples can be merged, there is one more
// candidate, which merges them.
//
// The result depends only on images and counters, so it is the same for every call. Throws
// InputError for a suite without the error_factors, and for a plan that counts instructions.
[[nodiscard]] ErrorRequest request_error(const Plan& plan, const ErrorSearch& search);

}  // namespace triptych::measure
