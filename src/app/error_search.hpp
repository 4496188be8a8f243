#pragma once
// The search of `run --error` and `render --error`: prints its progress, and stores its trial
// images in a temporary store.

#include <functional>
#include <string>

#include "measure/request/error_request.hpp"
#include "record/store.hpp"

namespace triptych::app {

// Measures a plan without times on the chosen devices, and returns the id of its run in the store.
using MeasureTrials = std::function<std::string(const measure::Plan&, record::Store&)>;

// See measure::request_error().
[[nodiscard]] measure::ErrorRequest search_settings(const measure::Plan& plan,
                                                    measure::SuiteWithTruth& suite,
                                                    const measure::ErrorGoal& goal,
                                                    measure::Truths& truths,
                                                    const MeasureTrials& measure_trials);

// Returns the names of the factors in --set options.
[[nodiscard]] std::set<std::string> names_of(const measure::Overrides& overrides);

}  // namespace triptych::app
