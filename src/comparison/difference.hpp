#pragma once
// One difference between two records or devices, as data. report/words/comparison.hpp makes the
// sentences, and docs/compare.md lists the causes for other programs.

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
  regression,   // b is wrong, does more, or changed something that must not change
  unjudged,     // no reference image, or b can no longer draw a configuration that a can draw
  fixed,        // a is wrong or cannot draw it, and b is right
  calibration,  // a statistic that at least one of the drivers does not count exactly
  changed       // an allowed difference between two devices, or b does less
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

// The reason for a difference. report/words/ has one sentence for each cause. Brackets list the
// data of a cause: numbers in quotes, facts in <angles>, other members by their names.
enum class DifferenceCause : std::uint8_t {
  ended,                   // a side did not measure the configuration [sides: how it ended]
  only_one_side,           // only one side has the configuration [side]
  no_reference,            // there is no reference image [sides: the reason]
  wrong_image,             // an image is wrong [sides: the errors of each wrong image]
  other_bits,              // both images are right, but not identical ["pixels" of "total", …]
  other_bits_of_one_code,  // the same, although device, settings and device code are equal
  two_counters,            // different emulators counted the instructions [<a> <b>]
  values_changed,          // values differ [changes]
  code_changed,            // the compiler's report differs [code]
  code_total,              // the total over all configurations differs [total]
  reported_by_one_side,    // only one side reports the value [side, changes: its value]
  same_driver,             // the value must not change on one driver [changes]
  api_specific,            // each API counts this value in its own way [changes]
  beyond_rounding,         // the values differ by more than rounding explains [changes]
  within_rounding,         // rounding explains the difference [changes]
  drivers_must_agree,      // the APIs define this value [changes]
  drivers_may_differ,      // the APIs leave this value to the driver [changes]
  counted_differently,     // a driver does not count the value exactly [changes, worths]
  calibration_changed,     // a driver now counts a statistic in another way [worths]
  limit_changed            // a limit of the device changed; a device may lack it [<a> <b>]
};
[[nodiscard]] std::string_view name_of(DifferenceCause cause);

// The observations of side a, and those of side b.
template <typename T>
using BySide = std::array<std::optional<T>, 2>;

struct Difference {
  DifferenceKind kind = DifferenceKind::changed;
  Subject subject = Subject::outcome;
  DifferenceCause cause = DifferenceCause::values_changed;
  std::string name = {};                   // name of the counter, statistic, limit or total
  std::optional<double> ratio = {};        // b divided by a, if both report it and it is not zero
  std::optional<measure::Side> side = {};  // the only side that has it
  std::map<std::string, double> numbers = {};
  std::map<std::string, std::string> facts = {};
  std::vector<judge::Change> changes = {};  // from a to b
  BySide<judge::Observation> sides = {};
  BySide<record::StatisticWorth> worths = {};
  std::optional<judge::CodeComparison> code = {};
  std::optional<judge::CodeTotal> total = {};
  std::string injected = {};  // faults that `run --inject` put into a side

  [[nodiscard]] std::string about() const;  // "image", "counter samples"
};

// Differences of one kind about one measurement, which are reported once.
struct DifferenceGroup {
  Difference difference;  // the one with the largest change, otherwise the first
  std::string where;      // its configuration; empty: the device
  int count = 0;
  std::optional<std::pair<double, double>> ratios;  // smallest and largest
};

// A difference with its configuration; empty: the device.
using Located = std::pair<std::string, Difference>;
// Sorted by kind with the worst first, then by measurement. Injected faults form groups of their
// own, so that nobody takes them for a driver's.
[[nodiscard]] std::vector<DifferenceGroup> grouped(const std::vector<Located>& differences);

}  // namespace triptych::comparison
