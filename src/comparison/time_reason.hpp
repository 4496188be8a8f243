#pragma once
// Why there is no verdict on the time of a configuration, and why it was measured by the wall
// clock, as data. report/words/comparison.hpp makes the sentences.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "comparison/pairwise.hpp"
#include "measure/run/interleaved.hpp"
#include "record/reason.hpp"

namespace triptych::comparison {

// The comments list what comes with each cause: numbers in quotes.
enum class TimeCause : std::uint8_t {
  none,
  side_ended,             // side, outcome, reason: this side did not measure it
  only_one_side,          // side: the other side does not have the configuration
  wrong_image,            // side: its image is wrong, so its time means nothing
  no_fresh_process_runs,  // suspected: they could not be measured
  not_confirmed,          // suspected, "ratio" of the first process run; "process_runs"
  undecided,              // "blocks" "half_width" of ln t: all blocks did not decide
  budget_ended            // "blocks" "half_width"
};
[[nodiscard]] std::string_view name_of(TimeCause cause);

struct TimeReason {
  TimeCause cause = TimeCause::none;
  measure::Side side = measure::Side::a;
  record::Outcome outcome = record::Outcome::measured;
  record::Reason reason = {};
  PairVerdict suspected = PairVerdict::undecided;
  std::map<std::string, double> numbers = {};

  [[nodiscard]] bool empty() const noexcept { return cause == TimeCause::none; }
};

// Why the wall clock was used instead of the device clocks.
enum class WallClockCause : std::uint8_t {
  none,              // the device clocks were used
  a_not_calibrated,  // the device clock of a did not pass its calibration
  b_not_calibrated,
  neither_calibrated,
  implausible  // the device times of the batches cannot be right
};
[[nodiscard]] std::string_view name_of(WallClockCause cause);

}  // namespace triptych::comparison
