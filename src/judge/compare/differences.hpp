#pragma once
// What differs between two records of one configuration, besides time, and what to think of it.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.hpp"
#include "judge/gate/gate.hpp"
#include "record/record.hpp"

namespace triptych::judge {

enum class DifferenceKind : std::uint8_t {
  regression,  // b is wrong, or changed what must not change
  unjudged,    // nothing to judge by: no truth, or a itself is wrong
  dialect,     // a statistic that at least one of the drivers counts in its own way
  expected     // two devices may differ so
};
[[nodiscard]] std::string_view name_of(DifferenceKind kind);

struct Difference {
  DifferenceKind kind = DifferenceKind::expected;
  std::string about;  // "image", "counter samples", "statistic fragment_invocations"
  std::string text;   // one line: both values, and why it is of its kind
};

// One side of a comparison: what it measured and on what.
struct ComparedSide {
  const record::Record& record;
  const record::Device& device;
  const core::Image& image;  // empty for a technique without a picture
  const TruthPair* truth = nullptr;
  std::string no_truth = {};  // why there is none
};

struct Comparison {
  std::vector<Difference> differences;  // worst first
  // Why no time of this configuration means anything: a picture is wrong. Empty: none is.
  std::string void_time;
};

// `same_setup`: both sides run the same program in the same environment, so that the same device
// code on the same device must make the same bits.
[[nodiscard]] Comparison find_differences(const ComparedSide& a, const ComparedSide& b,
                                          bool same_setup);

}  // namespace triptych::judge
