#pragma once
// Implements `--error E`: finds the configurations that meet a requested error and, after they have
// been measured, the fastest of them.

#include <functional>
#include <string>
#include <vector>

#include "accuracy/requested_error.hpp"
#include "measure/plan/plan.hpp"
#include "measure/truth/truths.hpp"
#include "record/record.hpp"

namespace triptych::measure {

struct ErrorRequest {
  Plan plan;  // contains the candidates for all scenes in which the error can be met
  // One line for each scene in which no candidate can meet the requested error, with the reason and
  // the smallest error that is possible in the scene.
  std::vector<std::string> unreachable;
};

// Chooses the levels of `step`, `quadrature`, `ert`, `skip` and `adapt`. The plan's levels of these
// factors are ignored.
//
// For each scene of the plan, the result contains one candidate for every quadrature and skipping
// mode. The requested error is divided into shares for the step size, for early ray termination and
// for merging samples. The step of a candidate is the longest step with which the error of the
// reference image, computed at the candidate's sample positions, stays within the share for the
// step size. If samples can be merged, there is one more candidate, which merges them. The step is
// estimated with a small image (accuracy::search_size()), and then shortened until the error of the
// complete image stays within the share.
//
// Throws InputError for a suite without these factors.
[[nodiscard]] ErrorRequest request_error(const Plan& plan, SuiteWithTruth& suite,
                                         const accuracy::RequestedError& request, Truths& truths,
                                         const std::function<void(const std::string&)>& report);

// The fastest record of one scene and device whose image meets the error.
struct ErrorAnswer {
  std::string device;
  std::string scene;                       // the factors that the request did not choose
  const record::Record* record = nullptr;  // null if no candidate meets the error on the device
  accuracy::ErrorsByMetric errors;         // errors of the record, or of the closest candidate
  accuracy::ErrorsByMetric empty_image;    // errors of an empty image
  double time_ns = 0;                      // median frame time of the record
};
// Returns the answers for all scenes and devices in the records, which must outlive the result. If
// a device drew no candidate for a scene although the scene was not skipped, its answer contains no
// numbers.
[[nodiscard]] std::vector<ErrorAnswer> answer_error(const std::vector<record::Record>& records,
                                                    const Suite& suite,
                                                    const accuracy::RequestedError& request,
                                                    Truths& truths);

// Returns the answer as one line of text.
[[nodiscard]] std::string describe(const ErrorAnswer& answer,
                                   const accuracy::RequestedError& request);

}  // namespace triptych::measure
