#pragma once
// `technique: auto`: every technique is measured, and of each scene and device the fastest is told
// with the numbers that say so. The choice is made of records alone: what repeats in them repeats.

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "measure/plan/plan.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// What the choice rests on: times, on the device's clock where it is trusted for all that compete,
// else on the wall clock; or, of plans that count them, the instructions of device code and driver.
enum class Ruler : std::uint8_t { device_clock, wall_clock, instructions };

struct Contestant {
  const record::Record* record = nullptr;
  double amount = 0;   // nanoseconds of the fastest frame, or instructions: what disturbs only adds
  double usually = 0;  // nanoseconds, the median; of instructions the same
};

struct FastestAnswer {
  std::string device;
  std::string scene;  // the factors that were not chosen
  Ruler ruler = Ruler::wall_clock;
  std::vector<Contestant> contestants;  // the fastest first; of equals the first measured
  std::vector<const record::Record*> not_drawn;
};

// Of every scene and device with more than one level of the factors chosen; of one measured
// repeatedly the fastest record counts. The records must outlive the result.
[[nodiscard]] std::vector<FastestAnswer> answer_fastest(const std::vector<record::Record>& records,
                                                        const Suite& suite,
                                                        const std::set<std::string>& chosen);

// Of a plan's one scene on one device, by a short trial of all and one more of those that may yet
// turn out to be the fastest: what disturbs a trial may double a time. No answer, or one without
// contestants: nothing could be told. The answers point into the records.
struct FastestTried {
  std::vector<record::Record> records;
  std::vector<FastestAnswer> answers;
};
// `trial`: measures the plan, and returns its records.
[[nodiscard]] FastestTried try_for_fastest(
    Plan plan, const Suite& suite,
    const std::function<std::vector<record::Record>(const Plan&)>& trial);

// One line of text: the choice, and by how much it beats each other one. One whose fastest frame is
// below the usual one of the choice is as fast.
[[nodiscard]] std::string describe(const FastestAnswer& answer,
                                   const std::set<std::string>& chosen);

}  // namespace triptych::measure
