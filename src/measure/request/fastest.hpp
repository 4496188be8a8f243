#pragma once
// `technique: auto`: every technique is measured, and the fastest one of each scene and device is
// reported with its numbers. The choice depends on records only, so it repeats if they do.

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "measure/plan/plan.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// The measurement that is compared: times, on the device clock if it is trusted for all
// competitors, otherwise on the wall clock; or instructions of device code and driver, for plans
// that count them.
enum class Ruler : std::uint8_t { device_clock, wall_clock, instructions };

struct Contestant {
  const record::Record* record = nullptr;
  // Nanoseconds of the fastest frame (disturbances only add time), or instructions.
  double amount = 0;
  double usually = 0;  // median in nanoseconds; for instructions the same as `amount`
};

struct FastestAnswer {
  std::string device;
  std::string scene;  // the factors that were not chosen
  Ruler ruler = Ruler::wall_clock;
  std::vector<Contestant> contestants;  // the fastest first; among equal ones the first measured
  std::vector<const record::Record*> not_drawn;
};

// Answers for every scene and device with more than one level of the chosen factors. If a
// combination of levels was measured repeatedly, its fastest record counts. The records must
// outlive the result.
[[nodiscard]] std::vector<FastestAnswer> answer_fastest(const std::vector<record::Record>& records,
                                                        const Suite& suite,
                                                        const std::set<std::string>& chosen);

// The result of trials of a plan with one scene on one device: a short trial of all techniques, and
// a second one of those that may still be the fastest, because a disturbance may double a time. If
// no technique can be chosen, there is no answer, or an answer without contestants. The answers
// point to the records.
struct FastestTried {
  std::vector<record::Record> records;
  std::vector<FastestAnswer> answers;
};
// `trial` measures the plan and returns its records.
[[nodiscard]] FastestTried try_for_fastest(
    Plan plan, const Suite& suite,
    const std::function<std::vector<record::Record>(const Plan&)>& trial);

// One line of text with the chosen levels and their advantage over each alternative. An alternative
// whose fastest frame is not above the median of the chosen one counts as equally fast.
[[nodiscard]] std::string describe(const FastestAnswer& answer,
                                   const std::set<std::string>& chosen);

}  // namespace triptych::measure
