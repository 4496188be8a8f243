#pragma once
// How a frame fails, by the rules of the gate.

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

// Whether two frames fail in the same way, whatever the numbers are; other counters are one way.
[[nodiscard]] bool is_same_kind(const Failure& a, const Failure& b);

// Where what a record is held against comes from.
struct Evidence {
  judge::FindTruth truth;
  std::function<core::Image(const record::Record&)> picture;  // that it names
  // The same configuration's record on another device, whose counters are right; nothing: counters
  // are held against nobody's.
  std::function<record::Record(const record::Record&)> other = {};
  judge::FindOpenCounts open_counts = {};
};

// It ended without a picture, else its picture is beyond the bound of the truth, else its counters
// are not those of the other device. Nothing: none of that, or it was skipped. Throws what the
// evidence throws.
[[nodiscard]] std::optional<Failure> failure_of(const record::Record& record,
                                                const Evidence& evidence);

}  // namespace triptych::reduction
