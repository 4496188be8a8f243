#pragma once
// Finds the answer to `--error E` in the records of its candidates.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measure/request/error_goal.hpp"
#include "measure/truth/truths.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// The fastest record of one device, scene and technique whose image meets the error.
struct ErrorAnswer {
  std::string device;
  std::string scene;                       // the factors that the request did not choose
  std::string compared_scene;              // `scene` without the technique
  const record::Record* record = nullptr;  // null if no candidate meets the error on the device
  accuracy::ErrorsByMetric errors;         // errors of the record, or of the closest candidate
  accuracy::ErrorsByMetric empty_image;    // errors of an empty image
  std::optional<record::Summary> time;     // of the record's frames, in nanoseconds
  // The clock of `time`: "device" if the device clock is trusted for all candidates with the same
  // `compared_scene`, and otherwise "wall". Times can therefore be compared within such a group.
  std::string_view clock = {};
};

// Returns the answers for all scenes and devices in the records, which must outlive the result. The
// answers with the same `compared_scene` are adjacent, and the fastest is first. If a device drew
// no candidate for a scene although the scene was not skipped, its answer contains no numbers.
[[nodiscard]] std::vector<ErrorAnswer> answer_error(const std::vector<record::Record>& records,
                                                    const Suite& suite, const ErrorGoal& goal,
                                                    Truths& truths);

// Returns whether the measurements leave open which answer is faster: the fastest frame of `other`
// did not take longer than the median frame of `best`.
[[nodiscard]] bool is_not_clearly_slower(const ErrorAnswer& other, const ErrorAnswer& best);

// Returns the records of the answers, one for each device, scene and technique, under a
// configuration that contains only the factors that the request did not choose. Answers of
// different devices can therefore be compared, although they may use different steps.
[[nodiscard]] std::vector<record::Record> answer_records(const std::vector<ErrorAnswer>& answers);

}  // namespace triptych::measure
