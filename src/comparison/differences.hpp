#pragma once
// Finds all differences between two records of the same configuration, except timing differences.

#include <string>
#include <vector>

#include "comparison/difference.hpp"
#include "comparison/time_reason.hpp"
#include "core/image.hpp"
#include "judge/gate/gate.hpp"
#include "record/record.hpp"

namespace triptych::comparison {

// One side of a comparison: a record and its device.
struct ComparedSide {
  const record::Record& record;
  const record::Device& device;
  const core::Image& image;  // empty if the technique produces no image
  const judge::TruthPair* truth = nullptr;
  std::string no_truth = {};  // the reason if there is no reference image
  judge::FindOpenCounts open_counts = {};
};

struct Comparison {
  std::vector<Difference> differences;  // worst first
  // The reason why the times of this configuration are meaningless; empty if the times are valid.
  TimeReason no_time;
};

// Finds the differences between two records. `same_setup` states that both sides run the same
// program in the same environment. In this case, the same device code on the same device must
// produce bit-identical images.
[[nodiscard]] Comparison find_differences(const ComparedSide& a, const ComparedSide& b,
                                          bool same_setup);

// Compares two descriptions of the same device, for example from before and after a driver upgrade.
// Finds limits and capabilities that were gained, lost or changed, and statistics whose calibration
// (how exactly the driver counts them) changed. Returns nothing for two different devices.
[[nodiscard]] std::vector<Difference> find_differences(const record::Device& a,
                                                       const record::Device& b);

}  // namespace triptych::comparison
