#pragma once
// Data types for a difference between two records or two devices. report/words/comparison.hpp
// converts a difference to a sentence. docs/compare.md documents the causes for programs that read
// the JSON output.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "judge/code/code_change.hpp"
#include "judge/code/code_totals.hpp"
#include "judge/finding.hpp"
#include "measure/run/interleaved.hpp"
#include "record/statistic_worth.hpp"

namespace triptych::comparison {

enum class DifferenceKind : std::uint8_t {
  regression,   // b is wrong, does more work, or changed something that must not change
  unjudged,     // there is no reference image, or b can no longer draw what a can draw
  fixed,        // a is wrong or cannot draw the configuration, but b is correct
  calibration,  // a statistic that at least one of the drivers does not count exactly
  changed       // an allowed difference between two devices, or b does less work
};
[[nodiscard]] std::string_view name_of(DifferenceKind kind);

// The measurement that differs.
enum class Subject : std::uint8_t {
  outcome,
  image,
  cost,
  preparing,
  code,
  code_total,
  memory,
  counter,
  statistic,
  limit
};
[[nodiscard]] std::string_view name_of(Subject subject);

// The cause of a difference between the two sides of a comparison, such as two devices or two
// stores. report/words/ has one sentence for each cause. The square brackets list the members of
// Difference that contain the data of a cause: entries of `numbers` in quotes, entries of `facts`
// in <angle brackets>, and other members by their names.
enum class DifferenceCause : std::uint8_t {
  ended,                   // a side did not measure the configuration [sides: the outcome]
  only_one_side,           // only one side has the configuration [side]
  no_reference,            // there is no reference image [sides: the reason]
  wrong_image,             // an image is wrong [sides: the errors of each wrong image]
  other_bits,              // both images are correct, but not identical ["pixels" of "total", …]
  other_bits_of_one_code,  // as for other_bits, although device, settings and device code are equal
  two_counters,            // the sides used different instruction counters [<a> <b>]
  values_changed,          // values such as instructions or bytes differ [changes]
  code_changed,            // the compiler's report differs [code]
  code_total,              // the total over all configurations differs [total]
  reported_by_one_side,    // only one side reports the value [side, changes: its value]
  same_driver,             // the value must not differ on the same driver [changes]
  api_specific,            // each API counts this value in its own way [changes]
  beyond_rounding,         // the values differ by more than rounding explains [changes]
  within_rounding,         // rounding explains the difference [changes]
  drivers_must_agree,      // the APIs define this value [changes]
  drivers_may_differ,      // the APIs leave this value to the driver [changes]
  counted_differently,     // a driver does not count the value exactly [changes, worths]
  calibration_changed,     // a driver now counts a statistic differently [worths]
  limit_changed            // a device limit changed, appeared or disappeared [<a> <b>]
};
[[nodiscard]] std::string_view name_of(DifferenceCause cause);

// The values for side a and for side b, in this order.
template <typename T>
using BySide = std::array<std::optional<T>, 2>;

struct Difference {
  DifferenceKind kind = DifferenceKind::changed;
  Subject subject = Subject::outcome;
  DifferenceCause cause = DifferenceCause::values_changed;
  std::string name = {};                   // name of the counter, statistic, limit or total
  std::optional<double> ratio = {};        // b divided by a, if both values exist and are not zero
  std::optional<measure::Side> side = {};  // the side, if only one side has the value
  std::map<std::string, double> numbers = {};
  std::map<std::string, std::string> facts = {};
  std::vector<judge::Change> changes = {};  // changes from a to b
  BySide<judge::Observation> sides = {};
  BySide<record::StatisticWorth> worths = {};
  std::optional<judge::CodeComparison> code = {};
  std::optional<judge::CodeTotal> total = {};
  std::string injected = {};  // faults injected into a side with --inject

  // Returns a number by which the differences of one group are sorted: |ln ratio|, the largest
  // |ln ratio| of a code statistic, or the largest error of an image. For a regression, only the
  // statistics that became worse are considered. Returns 0 if the difference has no size.
  [[nodiscard]] double size() const;
  [[nodiscard]] std::string about() const;  // the measurement, such as "image" or "counter samples"
};

// A configuration, and a difference between its two records. The configuration is empty for a
// difference between the devices.
using LocatedDifference = std::pair<std::string, Difference>;

// Differences of the same kind in the same measurement, which are reported together.
struct DifferenceGroup {
  Difference difference;  // the largest change, or the first difference if none has a size
  std::string where;      // configuration of `difference`; empty: a difference between devices
  int count = 0;
  std::optional<std::pair<double, double>> ratios;  // the smallest and the largest `ratio`
  std::vector<LocatedDifference> members = {};      // all differences, the largest first
};

// Groups the differences. The groups are sorted by kind (worst first) and then by measurement.
// Injected faults form separate groups, so that nobody mistakes them for driver faults.
[[nodiscard]] std::vector<DifferenceGroup> grouped(
    const std::vector<LocatedDifference>& differences);

}  // namespace triptych::comparison
