#pragma once
// Data types for two kinds of reasons: why there is no verdict on the time of a configuration, and
// why its time was measured with the wall clock. report/words/comparison.hpp converts these reasons
// to sentences.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "comparison/pairwise.hpp"
#include "measure/run/interleaved.hpp"
#include "record/reason.hpp"

namespace triptych::comparison {

// The reason why there is no verdict on a time. The two sides a and b of a comparison are, for
// example, two devices or two drivers. The square brackets list the members of TimeReason that
// contain the data of a cause: entries of `numbers` in quotes, and other members by their names.
enum class TimeCause : std::uint8_t {
  none,
  side_ended,             // a side did not measure the configuration [side, outcome, reason]
  only_one_side,          // only one side has the configuration [side]
  wrong_image,            // the image of a side is wrong, so its time has no meaning [side]
  no_fresh_process_runs,  // no new worker processes could be measured
                          // [suspected "half_width" "most"]
  not_confirmed,          // new worker processes did not confirm that b is slower or faster
                          // [suspected "ratio" "process_runs" "half_width" "most"]
  undecided,              // all blocks were measured without a decision
                          // ["blocks" "half_width" "most"]
  budget_ended            // the time budget ended before a decision ["blocks" "half_width" "most"]
};
[[nodiscard]] std::string_view name_of(TimeCause cause);

struct TimeReason {
  TimeCause cause = TimeCause::none;
  measure::Side side = measure::Side::a;
  record::Outcome outcome = record::Outcome::measured;
  record::Reason reason = {};
  PairVerdict suspected = PairVerdict::undecided;
  // "half_width" is half the width of the confidence interval of the shift, and "most" is the
  // largest distance from 0 of any shift in that interval.
  std::map<std::string, double> numbers = {};

  [[nodiscard]] bool empty() const noexcept { return cause == TimeCause::none; }
};

// The reason why the wall clock was used instead of the device clocks.
enum class WallClockCause : std::uint8_t {
  none,              // the device clocks were used
  a_not_calibrated,  // the device clock of side a failed its calibration
  b_not_calibrated,
  neither_calibrated,
  implausible  // a device time is 0, longer than the wall-clock time, or much shorter
};
[[nodiscard]] std::string_view name_of(WallClockCause cause);

}  // namespace triptych::comparison
