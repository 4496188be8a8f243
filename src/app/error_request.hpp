#pragma once
// `--error E`: configurations that keep a requested error, and the cheapest of them once they are
// measured.

#include <functional>
#include <string>
#include <vector>

#include "accuracy/accuracy.hpp"
#include "app/truth.hpp"
#include "measure/plan/plan.hpp"

namespace triptych::app {

// What the request decides: `step`, `quadrature`, `ert`, `skip` and `adapt`. Whatever the plan says
// of them is not looked at.
//
// The plan with each of its scenes in these candidates: for every quadrature the longest step that
// keeps the step's share of the error, by the truth on its lattice against the limit on the same
// rays – those of the picture at no more than 48 pixels a side – early termination by its own
// share, every mode of skipping, and merged samples where there are any to merge. Throws InputError
// for a suite without such factors, for an error that is not positive and for a scene where no step
// is short enough.
[[nodiscard]] measure::Plan plan_within_error(const measure::Plan& plan,
                                              measure::SuiteWithTruth& suite, double error,
                                              const std::function<void(const std::string&)>& tell);

// Per scene and device the fastest record whose picture is within the error of its limit.
struct ErrorAnswer {
  std::string device;
  std::string scene;                       // the factors that were not chosen
  const record::Record* record = nullptr;  // none where the device keeps the error in no candidate
  double rmse = 0;                         // of the record; else the least that there is
  double time_ns = 0;                      // of the record
};
// The records must outlive the result.
[[nodiscard]] std::vector<ErrorAnswer> answer_error(const std::vector<record::Record>& records,
                                                    const measure::Suite& suite, Truths& truths,
                                                    double error);

// One line of text.
[[nodiscard]] std::string describe(const ErrorAnswer& answer, double error);

}  // namespace triptych::app
