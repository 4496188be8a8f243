#pragma once
// Determines how a frame fails, by the rules of the gate.

#include <functional>
#include <optional>

#include "core/image.hpp"
#include "judge/finding.hpp"
#include "judge/gate/open_counts.hpp"
#include "judge/stress/stress.hpp"
#include "record/record.hpp"

namespace triptych::reduction {

// How a frame fails: it ended without an image, its image is wrong, or its counters changed.
using Failure = judge::Observation;

// Whether two frames fail in the same way, independent of the numbers. Changed counters count as
// one way.
[[nodiscard]] bool is_same_kind(const Failure& a, const Failure& b);

// The data with which a record is compared.
struct Evidence {
  judge::FindTruth truth;
  std::function<core::Image(const record::Record&)> picture;  // the image that the record refers to
  // Returns the record of the same configuration on another device, whose counters are right. If it
  // is not set, counters are not compared.
  std::function<record::Record(const record::Record&)> other = {};
  judge::FindOpenCounts open_counts = {};
};

// Returns the first failure that applies: the frame ended without an image, its image is outside
// its error bound, or its counters differ from those of the other device. nullopt if none applies,
// or if the frame was skipped. Throws what the functions of the evidence throw.
[[nodiscard]] std::optional<Failure> failure_of(const record::Record& record,
                                                const Evidence& evidence);

}  // namespace triptych::reduction
