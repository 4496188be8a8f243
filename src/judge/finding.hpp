#pragma once
// Findings of the judge, as data. report/words/ makes a sentence of each cause. Nothing compares
// `detail`, which quotes drivers, libraries and people. docs/report.md lists the causes for other
// programs.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "judge/baselines/waivers.hpp"
#include "record/check.hpp"
#include "record/record.hpp"

namespace triptych::judge {

using record::Check;
using record::check;
using record::name_of;

enum class Verdict : std::uint8_t {
  pass,
  improved,      // passes, and is better than the baseline beyond doubt
  advisory,      // worth knowing, decides nothing: times, another driver version
  skipped,       // the device cannot do this; the cause says why
  waived,        // a regression that is known: waivers.json or a file of expectations has it
  cannot_judge,  // no baseline, nothing measured, other data: never a pass
  regression
};
[[nodiscard]] std::string_view name_of(Verdict verdict);

// One per sentence. The comments name what comes with it: numbers in quotes, facts in <angles>.
enum class Cause : std::uint8_t {
  none,
  // Of any check.
  as_stored,           // "values" that equal the stored ones; names: those that were not compared
  values_changed,      // changes
  unknown_values,      // names: of values without a stored counterpart
  not_stored,          // names: configurations of which nothing is stored
  no_stored_device,    // nothing is stored of this device or driver version
  not_reported,        // the device or the technique reports nothing of the kind
  no_longer_reported,  // names: configurations that reported it when they were accepted
  untimed,             // the run was not timed, so that it was not read
  // Of a run as a whole.
  ended,               // a record that was not measured: outcome, reason
  no_run,              // no run was begun
  nothing_measured,    // <run> <plan> "records"
  no_required_device,  // <glob>
  device_missing,      // <sibling>: a device that was accepted with the same driver version
  listing_failed,      // <what>; reason
  no_description,      // <run>: of a device that it has records of
  checks_lost,         // names: checks of the baselines that the plan does not ask for
  missing,             // names: configurations without a record; "wanted" of them, <kind>
  extra,               // names: configurations that the plan lacks
  other_plan,          // <run> <plan> <hash> <now>
  other_data,          // <hash> <accepted>: not the data that were accepted
  data_changed,        // <hash> <now>: not the data that were measured
  no_baselines,        // <folder>
  nothing_decided,     // of a device
  device_fault,        // found apart from any configuration: <kind> <subject> <last_words>; detail
  unused_waiver,       // expired, and excuses nothing: <test> <device> <expiry> <reason>
  waiver_of_no_test,   // <test>
  // Of images.
  within_bound,
  pixels_over_bound,
  not_finite,
  other_surface,  // another particle, or the right one at another depth
  size_differs,
  empty_image,
  no_image,           // the record holds none
  unreadable_image,   // detail
  no_reference,       // detail
  reference_changed,  // because: how; without: by its hash
  reference_as_stored,
  devices_agree,     // <other> "rms" "allowed"
  devices_disagree,  // likewise
  // Of statistics.
  other_driver_statistics,  // <driver_version> changes names
  // Of cost and memory.
  two_counters,       // <counted_by> <other>
  other_counter,      // <counted_by> <other> <driver_version> <other_version>
  frame_allocations,  // changed; "configurations", <configuration>, changes: the largest
  preparing,          // likewise
  injected_memory,    // an injected slowdown takes memory itself
  // Code of GPUs.
  other_executables,  // names: those that only one of the two was compiled in
  other_disassembly,  // names: configurations whose statistics did not change
  other_compiler,     // <driver_version> <other_version> "configurations" "changed"; changes: totals
  // Of times.
  time,         // "median_ns" "baseline_ns" "ratio" "half_width"
  times,        // over all configurations of a device
  other_clock,  // names
  no_time,
  same_frames,  // reason
  wrong_image,  // because: what is wrong with it
  // Of correlations.
  residuals_as_stored,  // names: devices
  residual_moved,       // names: devices
  off_the_line,         // <other>
  on_the_line,          // <other>
  no_line,              // <other> "refusal"
  no_partner,           // <counted_by>
  // Of accuracy.
  error,              // "rmse" "bound"
  unknown_error,      // detail
  not_comparable,     // of another size, or not finite
  no_limit,           // no scene of the plan has one
  no_limit_any_more,  // an error is stored of a scene that has none
  order,              // "order" "half_width" "stored_order" "stored_half_width"
  no_order,           // "stored_order" "stored_half_width"
  // Of stress cases.
  score,           // "score" "accepted"; because: what lost the points
  farther_device,  // <other> "rms" "allowed" "rmse" "rmse_of_other"
  pixels_differ,   // <levels> of the other image; detail: what is expected
  no_other_image,  // <levels>; detail
  not_inside,      // detail; this image does not lie in the other one
  other_colour,    // detail
  not_counted,     // detail; <counter> <levels>
  count_too_large  // detail; <counter> <of> <levels> "count" "factor" "unit"
};
[[nodiscard]] std::string_view name_of(Cause cause);

// The other side of the comparison.
enum class Against : std::uint8_t {
  nothing,
  reference,      // the reference image
  stored_image,   // the image that was accepted
  baseline,       // values that the same driver version was accepted with
  other_devices,  // values that other devices or driver versions were accepted with
  expectation,    // what a stress case expects
};
[[nodiscard]] std::string_view name_of(Against against);

// The next step for the reader.
enum class Advice : std::uint8_t {
  none,
  accept,  // `command` does it
  run_again,
  resume,        // `command` does it
  restore_data,  // or accept: `command`
  restore_or_run_again,
  restore_baselines,  // from version control, or start over: `command`
  count,              // or leave the check out
  judge_more,         // or accept: `command`
  more_time,          // a longer --limit
  times,              // --times makes times decide
  repair_driver,      // or state that the machine lacks it: `command`
  remove_entry,       // from the file of expectations
  remove_waiver
};
[[nodiscard]] std::string_view name_of(Advice advice);

struct Advised {
  Advice advice = Advice::none;
  std::string command = {};
};

enum class Unit : std::uint8_t { count, instructions, bytes, misses, allocations };
[[nodiscard]] std::string_view name_of(Unit unit);

// A value that is not what it was compared with.
struct Change {
  std::string name;
  Unit unit = Unit::count;
  std::optional<double> before = {};            // none: there was no such value
  std::optional<double> now = {};               // none: it is missing
  std::map<std::string, double> accepted = {};  // by device, where several were compared with
  double allowed = 0;                           // difference
};

struct Observation {
  Cause cause = Cause::none;
  Against against = Against::nothing;
  std::map<std::string, double> numbers = {};  // finite; the unit is in the name
  std::vector<Change> changes = {};
  std::vector<std::string> names = {};            // of configurations, values or devices
  std::map<std::string, std::string> facts = {};  // identifiers
  std::string detail = {};                        // what a library or an exception says
  record::Outcome outcome = record::Outcome::measured;
  record::Reason reason = {};
  std::vector<Observation> because = {};

  [[nodiscard]] double number(const std::string& name) const;  // 0 where there is none
  [[nodiscard]] const std::string& fact(const std::string& name) const;
};
// Equal for observations of one cause, whatever their numbers and texts are.
[[nodiscard]] std::string kind_of(const Observation& what);
// Infinities and NaN are left out: JSON has none, and missing is not zero.
void set_number(Observation& what, const std::string& name, double value);

// How a waiver or a file of expectations changed a finding.
struct Excuse {
  enum class Of : std::uint8_t {
    nothing,
    waived,      // by waivers.json
    expired,     // a waiver for it has expired
    known,       // by a file of expectations
    unexpected,  // a skip or a pass that the file does not expect
  };
  Of of = Of::nothing;
  Known known = Known::fail;
  std::string reason = {};
  std::string expiry = {};
};
[[nodiscard]] std::string_view name_of(Excuse::Of of);

// The result of drawing a regression again.
enum class Again : std::uint8_t {
  not_drawn,
  flake,  // right the second time
  slow,   // a timeout that was right the second time: slow, or it hangs at times
  other   // Finding::again says what
};
[[nodiscard]] std::string_view name_of(Again again);

// One answer about one configuration on one device (both empty where the finding is about the whole
// plan).
struct Finding : Observation {
  Check check = Check::image;
  Verdict verdict = Verdict::pass;
  std::string test = {};  // test id, Record::test_id
  std::string device = {};
  std::string configuration = {};
  // What of the device and configuration, where that is not all of it: "program", "step=0.5"; of a
  // correlation also by which device.
  std::string subject = {};
  Advised advice = {};
  std::vector<std::string> injected = {};  // faults that `run --inject` put into it
  // Of a regression on a driver version that was never accepted: the devices that were accepted
  // with its configuration, the same one with another version among them.
  std::vector<std::string> accepted_on = {};
  bool measured_before = false;  // of a skip: the device measured it when it was accepted
  Excuse excuse = {};
  Again drawn_again = Again::not_drawn;
  std::vector<Observation> again = {};  // what was found then, where that is another cause
};
// Likewise, with the excuse and the injected faults.
[[nodiscard]] std::string kind_of(const Finding& finding);
// Whether it says how a program ended: by an error, a crash, a timeout or a lost device.
[[nodiscard]] bool ended_a_program(const Finding& finding);

}  // namespace triptych::judge
