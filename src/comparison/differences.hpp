#pragma once
// The differences between two records of one configuration, except in time, and their kinds.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.hpp"
#include "judge/gate/gate.hpp"
#include "record/record.hpp"

namespace triptych::comparison {

enum class DifferenceKind : std::uint8_t {
  regression,   // b is wrong, does more, or changed something that must not change
  unjudged,     // no reference image, or b can no longer draw what a can
  fixed,        // a is wrong or cannot draw it, and b is right
  calibration,  // a statistic that at least one of the drivers counts in its own way
  changed       // an allowed difference between two devices, or b does less
};
[[nodiscard]] std::string_view name_of(DifferenceKind kind);

struct Difference {
  DifferenceKind kind = DifferenceKind::changed;
  std::string about;  // "image", "counter samples", "cost", "memory", "statistic …", "limit …"
  std::string text;   // one line with both values and the reason for its kind
  // b divided by a, if both report the number and it is not zero.
  std::optional<double> ratio = {};
  std::string injected = {};  // faults that `run --inject` put into a side; the text names them
};

// One side of a comparison: what was measured, and on which device.
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
  // The reason why times of this configuration are meaningless: one side did not measure it, or an
  // image is wrong. Empty if times are valid.
  std::string void_time;
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
