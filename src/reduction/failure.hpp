#pragma once
// Determines how a frame fails, using the same rules as `triptych gate`.

#include <functional>
#include <optional>

#include "core/image.hpp"
#include "judge/finding.hpp"
#include "judge/gate/open_counts.hpp"
#include "judge/stress/stress.hpp"
#include "record/record.hpp"

namespace triptych::reduction {

// How a frame fails: it ends without an image, its image is wrong, or its counters are wrong.
using Failure = judge::Observation;

// Returns whether two frames fail in the same way, regardless of the numbers. Frames with wrong
// counters always fail in the same way, whichever counters are wrong.
[[nodiscard]] bool is_same_kind(const Failure& a, const Failure& b);

// The functions that provide the data with which a record is compared.
struct Evidence {
  judge::FindTruth truth;
  std::function<core::Image(const record::Record&)> image;  // returns the record's image
  // Returns the record of the same configuration on another device, whose counters are assumed to
  // be correct. If this function is not set, counters are not compared.
  std::function<record::Record(const record::Record&)> other = {};
  judge::FindOpenCounts open_counts = {};
};

// Returns the first of these failures that applies: the frame ended without an image, its image
// exceeds its error bound, or its counters differ from those of the other device. Returns nullopt
// if no failure applies or if the frame was skipped. Throws the exceptions that the functions in
// `evidence` throw.
[[nodiscard]] std::optional<Failure> failure_of(const record::Record& record,
                                                const Evidence& evidence);

}  // namespace triptych::reduction
