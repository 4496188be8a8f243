#pragma once
// What the analysis works on: one observation per configuration and device, joined from the records
// of several stores. Everything below it is plain numbers.

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "record/record.hpp"

namespace triptych::analysis {

// A record and where it comes from.
struct Source {
  std::string file;  // the store
  record::Run run;
  record::Device device;
  record::Record record;
};

struct Observation {
  std::map<std::string, std::string> factors;  // with "device"
  double ms = 0;                               // median of the frames, on the data set's clock
  std::optional<double> device_ms;             // absent where the device's clock is not trusted
  double wall_ms = 0;
};

// The same configuration on the same device in two runs: `dropped` is the older.
struct Duplicate {
  std::string device, configuration, taken, dropped;  // the latter two "RUN in FILE"
};

struct Dataset {
  std::string suite;
  std::string clock;  // "device" or "wall", one for all
  std::vector<Observation> observations;
  std::vector<Duplicate> duplicates;
  std::vector<std::string> notes;  // what was left aside, and why
};

// automatic: device time where every record of the suite has one that is trusted, else wall-clock
// time for all of them – two clocks never meet in one number.
enum class ClockChoice : std::uint8_t { automatic, device, wall };
[[nodiscard]] ClockChoice clock_choice(std::string_view name);  // throws core::InputError

// One data set per suite, by name. Left aside, with a note: what was not measured, planted faults,
// techniques without a picture, and on ClockChoice::device records without a trusted device time.
// A device that appears with another driver or processor under the same id becomes a level of its
// own, ID@HASH. Factors are those of the records; one that only the device chose (an `auto` that
// no configuration names) is none.
[[nodiscard]] std::vector<Dataset> join(std::span<const Source> sources, ClockChoice choice);

// The whole text as a number.
[[nodiscard]] std::optional<double> number(std::string_view text);

// "a10" after "a9": numbers, and runs of digits within other text, compare by value.
[[nodiscard]] bool natural_less(std::string_view a, std::string_view b);

// "orbit_y:1/8" → {"orbit_y", "1/8"}; "random:7" → {"random", "7"}.
struct View {
  std::string path, position;
};
[[nodiscard]] View view_of(std::string_view camera);

}  // namespace triptych::analysis
