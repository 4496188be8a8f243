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

namespace triptych::comparison {

enum class DifferenceKind : std::uint8_t {
  regression,   // b is wrong or does more, or changed what must not change
  unjudged,     // nothing to judge by: no truth, or b cannot do any more what a can
  fixed,        // a is wrong, or cannot do it; b is right
  calibration,  // a statistic that at least one of the drivers counts in its own way
  changed       // two devices may differ so, or b does less
};
[[nodiscard]] std::string_view name_of(DifferenceKind kind);

struct Difference {
  DifferenceKind kind = DifferenceKind::changed;
  std::string about;  // "image", "counter samples", "cost", "memory", "statistic …", "limit …"
  std::string text;   // one line: both values, and why it is of its kind
  // b over a, of a number that both tell and that is no nothing.
  std::optional<double> ratio = {};
  std::string injected = {};  // faults that `run --inject` put into a side; the text names them
};

// One side of a comparison: what it measured and on what.
struct ComparedSide {
  const record::Record& record;
  const record::Device& device;
  const core::Image& image;  // empty for a technique without a picture
  const judge::TruthPair* truth = nullptr;
  std::string no_truth = {};  // why there is none
  judge::FindOpenCounts open_counts = {};
};

struct Comparison {
  std::vector<Difference> differences;  // worst first
  // Why no time of this configuration means anything: one side did not measure it, or a picture is
  // wrong. Empty: none is.
  std::string void_time;
};

// `same_setup`: both sides run the same program in the same environment, so that the same device
// code on the same device must make the same bits.
[[nodiscard]] Comparison find_differences(const ComparedSide& a, const ComparedSide& b,
                                          bool same_setup);

// Limits and capabilities gained, lost and changed, and how statistics are counted, of two versions
// of one device; of two devices nothing.
[[nodiscard]] std::vector<Difference> find_differences(const record::Device& a,
                                                       const record::Device& b);

}  // namespace triptych::comparison
