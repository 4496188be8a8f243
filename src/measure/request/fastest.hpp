#pragma once
// Implements `technique: auto`: every technique is measured, and the fastest technique for each
// scene and device is reported with its numbers. The choice depends only on records, so the same
// records always lead to the same choice.

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "measure/plan/plan.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// The measurement that is compared. For plans that count instructions, it is the number of
// instructions in device code and driver. Otherwise it is the time on the device clock if that
// clock is trusted for all candidates (the records that are compared), or else the time on the
// wall clock.
enum class ComparedQuantity : std::uint8_t { device_clock, wall_clock, instructions };

struct Candidate {
  const record::Record* record = nullptr;
  // The time of the fastest frame in nanoseconds, or the number of instructions. The fastest frame
  // is used because disturbances only add time.
  double amount = 0;
  double median = 0;  // median frame time in nanoseconds; for instructions, equal to `amount`
};

struct FastestAnswer {
  std::string device;
  std::string scene;  // the factors that are not chosen automatically
  ComparedQuantity quantity = ComparedQuantity::wall_clock;
  std::vector<Candidate> candidates;  // fastest first; ties in the order of measurement
  std::vector<const record::Record*> not_drawn;
};

// Returns an answer for every scene and device for which several levels of the chosen factors were
// measured. If a combination of levels was measured repeatedly, its fastest record counts. The
// records must outlive the result.
[[nodiscard]] std::vector<FastestAnswer> answer_fastest(const std::vector<record::Record>& records,
                                                        const Suite& suite,
                                                        const std::set<std::string>& chosen);

// The result of trials of a plan with one scene on one device. The first trial is short and
// contains all techniques. The second trial contains the techniques that may still be the fastest,
// because a disturbance may have doubled a time in the first trial. If no technique can be chosen,
// there is no answer, or an answer without candidates. The answers point to the records.
struct FastestTrials {
  std::vector<record::Record> records;
  std::vector<FastestAnswer> answers;
};
// Runs the trials. `trial` measures a plan and returns its records.
[[nodiscard]] FastestTrials find_fastest(
    Plan plan, const Suite& suite,
    const std::function<std::vector<record::Record>(const Plan&)>& trial);

// Returns a line with the chosen levels and their advantage over each alternative. The line adds
// "(no clear difference)" to an alternative whose fastest frame did not take longer than the median
// frame of the chosen levels.
[[nodiscard]] std::string describe(const FastestAnswer& answer,
                                   const std::set<std::string>& chosen);

}  // namespace triptych::measure
