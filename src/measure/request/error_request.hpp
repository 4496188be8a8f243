#pragma once
// `--error E`: configurations that keep a requested error, and the cheapest of them once they are
// measured.

#include <functional>
#include <string>
#include <vector>

#include "accuracy/requested_error.hpp"
#include "measure/plan/plan.hpp"
#include "measure/truth/truths.hpp"
#include "record/record.hpp"

namespace triptych::measure {

struct ErrorRequest {
  Plan plan;  // of the scenes that may be kept
  // The others, a line of text each: why, and the least error there.
  std::vector<std::string> out_of_reach;
};

// What the request decides: `step`, `quadrature`, `ert`, `skip` and `adapt`. Whatever the plan says
// of them is not looked at.
//
// The plan with each of its scenes in these candidates: for every quadrature the longest step whose
// picture – the truth on its lattice – keeps the step's share of the error, early termination by
// its own share, every mode of skipping, and merged samples where there are any to merge. The step
// is looked for on a picture of few pixels (accuracy::search_size), and shortened until the whole
// picture keeps it. Throws InputError for a suite without such factors.
[[nodiscard]] ErrorRequest request_error(const Plan& plan, SuiteWithTruth& suite,
                                         const accuracy::RequestedError& request, Truths& truths,
                                         const std::function<void(const std::string&)>& tell);

// Per scene and device the fastest record whose picture keeps the error.
struct ErrorAnswer {
  std::string device;
  std::string scene;                       // the factors that were not chosen
  const record::Record* record = nullptr;  // none where the device keeps the error in no candidate
  accuracy::PictureErrors errors;          // of the record; else of the nearest that there is
  accuracy::PictureErrors nothing;         // of a picture in which nothing is drawn
  double time_ns = 0;                      // of the record
};
// The records must outlive the result. A scene that a device drew no candidate of, though it was
// not skipped, has an answer without numbers.
[[nodiscard]] std::vector<ErrorAnswer> answer_error(const std::vector<record::Record>& records,
                                                    const Suite& suite,
                                                    const accuracy::RequestedError& request,
                                                    Truths& truths);

// One line of text.
[[nodiscard]] std::string describe(const ErrorAnswer& answer,
                                   const accuracy::RequestedError& request);

}  // namespace triptych::measure
