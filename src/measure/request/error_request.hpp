#pragma once
// `--error E`: finds the configurations that meet a requested error, and, after they have been
// measured, the fastest of them.

#include <functional>
#include <string>
#include <vector>

#include "accuracy/requested_error.hpp"
#include "measure/plan/plan.hpp"
#include "measure/truth/truths.hpp"
#include "record/record.hpp"

namespace triptych::measure {

struct ErrorRequest {
  Plan plan;  // contains the candidates for all scenes that can meet the error
  // One line for each scene that cannot meet the error, with the reason and the scene's smallest
  // error.
  std::vector<std::string> out_of_reach;
};

// Chooses `step`, `quadrature`, `ert`, `skip` and `adapt`. The plan's values of these factors are
// ignored.
//
// For each scene of the plan, the result contains one candidate for every quadrature and skipping
// mode. Its step is the longest step with which the error of the reference image, computed with the
// candidate's sample positions, stays within the step's share of the requested error. Early ray
// termination gets its own share. If samples can be merged, another candidate merges them. The step
// is estimated with an image of few pixels (accuracy::search_size), and then shortened until the
// error of the whole image stays within the share. Throws InputError for a suite without these
// factors.
[[nodiscard]] ErrorRequest request_error(const Plan& plan, SuiteWithTruth& suite,
                                         const accuracy::RequestedError& request, Truths& truths,
                                         const std::function<void(const std::string&)>& tell);

// For one scene and device, the fastest record whose image meets the error.
struct ErrorAnswer {
  std::string device;
  std::string scene;                       // the factors that were not chosen
  const record::Record* record = nullptr;  // null if no candidate meets the error on the device
  accuracy::PictureErrors errors;          // errors of the record, or of the closest candidate
  accuracy::PictureErrors nothing;         // errors of an empty image
  double time_ns = 0;                      // time of the record
};
// The records must outlive the result. If a device drew no candidate of a scene although the scene
// was not skipped, its answer has no numbers.
[[nodiscard]] std::vector<ErrorAnswer> answer_error(const std::vector<record::Record>& records,
                                                    const Suite& suite,
                                                    const accuracy::RequestedError& request,
                                                    Truths& truths);

// Returns the answer as one line of text.
[[nodiscard]] std::string describe(const ErrorAnswer& answer,
                                   const accuracy::RequestedError& request);

}  // namespace triptych::measure
