#pragma once
// Finds the differences between two records of one configuration, except in time.

#include <string>
#include <vector>

#include "comparison/difference.hpp"
#include "comparison/time_reason.hpp"
#include "core/image.hpp"
#include "judge/gate/gate.hpp"
#include "record/record.hpp"

namespace triptych::comparison {

// One side of a comparison: the record, and its device.
struct ComparedSide {
  const record::Record& record;
  const record::Device& device;
  const core::Image& image;  // empty for a technique without an image
  const judge::TruthPair* truth = nullptr;
  std::string no_truth = {};  // why there is no reference image
  judge::FindOpenCounts open_counts = {};
};

struct Comparison {
  std::vector<Difference> differences;  // worst first
  // Why times of this configuration are meaningless; empty if they are valid.
  TimeReason no_time;
};

// `same_setup`: both sides run the same program in the same environment, so that the same device
// code on the same device must give the same bits.
[[nodiscard]] Comparison find_differences(const ComparedSide& a, const ComparedSide& b,
                                          bool same_setup);

// Limits and capabilities that were gained, lost or changed, and changes of the statistics
// calibration, for two versions of one device. For two different devices nothing is compared.
[[nodiscard]] std::vector<Difference> find_differences(const record::Device& a,
                                                       const record::Device& b);

}  // namespace triptych::comparison
