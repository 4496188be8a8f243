#pragma once
// All sentences about `--error E`: its progress, its answers, and the reasons why there is none.
// The sentences contain names of data files, so callers must escape them for the output format.

#include <string>

#include "accuracy/requested_error.hpp"
#include "measure/contract/suite.hpp"
#include "measure/request/error_answer.hpp"
#include "measure/request/error_progress.hpp"

namespace triptych::report::words {

// "computing the limit image of 512x512 pixels".
[[nodiscard]] std::string text_of(const measure::Rendering& rendering);
// Describes what the search is computing.
[[nodiscard]] std::string text_of(const measure::ErrorProgress& progress);
// States why no settings can meet the requested error in a scene, and what the user can do.
[[nodiscard]] std::string text_of(const measure::Unreachable& unreachable,
                                  const accuracy::RequestedError& request);
// States that no candidate meets the error on a device. `answer.record` must be null.
[[nodiscard]] std::string text_of_missed(const measure::ErrorAnswer& answer,
                                         const accuracy::RequestedError& request);
// States the errors of an answer's image in all metrics.
[[nodiscard]] std::string text_of_errors(const measure::ErrorAnswer& answer,
                                         const accuracy::RequestedError& request);

}  // namespace triptych::report::words
